#pragma once
#include <vector>

#include "host/robot/model/entity.hpp"

/// Which links of one robot may not collide with each other. Neighbours never do: they overlap at
/// their joint. All others do, but for pairs that its file declares, and for links a few joints
/// apart that overlap by construction.
namespace verp::model {

/// Links up to this many joints apart may overlap where the robot stands: a hip's three axes meet
/// in one point, and the boxes around them do not fit beside each other.
inline constexpr int kNearJoints = 3;

struct Overlap {
  int link = 0, other = 0;  ///< nodes, link < other
  double depth_m = 0;
};

/// Links that overlap at these joint angles, neighbours left out.
std::vector<Overlap> overlaps(const Entity& entity, const std::vector<double>& joint_rad);

/// How many joints lie between two links; kMaxJoints if neither carries the other.
int joints_between(const Entity& entity, int link, int other);

/// Links that overlap where they shall stay for a while.
struct Clash {
  Overlap overlap;
  const char* pose;  ///< standing or sitting
};

/// Adds to entity.no_collide the near links that overlap at the zero, standing or sitting pose.
/// Returns the other pairs that overlap standing or sitting and are not declared: such a robot
/// would push itself apart.
std::vector<Clash> find_near_overlaps(Entity& entity);

}  // namespace verp::model
