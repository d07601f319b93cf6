#pragma once
#include <vector>

#include "host/robot/model/entity.hpp"

/// Pairs of a robot's links that must not collide. Neighbours overlap at their joint, so they never
/// collide. All others do, except the file's declared pairs, and links a few joints apart that
/// overlap by construction.
namespace verp::model {

/// Links up to this many joints apart may overlap in the standing pose: a hip's three axes meet in
/// one point, and the boxes around them overlap.
inline constexpr int kNearJoints = 3;

struct Overlap {
  int link = 0, other = 0;  ///< nodes, link < other
  double depth_m = 0;
};

/// Overlapping links at these joint angles, without neighbours.
std::vector<Overlap> overlaps(const Entity& entity, const std::vector<double>& joint_rad);

/// Number of joints between two links; kMaxJoints if neither carries the other.
int joints_between(const Entity& entity, int link, int other);

/// Links that overlap in a resting pose.
struct Clash {
  Overlap overlap;
  const char* pose;
};

/// Adds to entity.no_collide the near links that overlap at the zero, standing or sitting pose.
/// Returns other undeclared pairs that overlap standing or sitting: such a robot would push itself
/// apart.
std::vector<Clash> find_near_overlaps(Entity& entity);

}  // namespace verp::model
