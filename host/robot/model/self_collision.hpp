#pragma once
#include <vector>

#include "host/robot/model/entity.hpp"

/// Pairs of links that must not collide. Neighbours overlap at their joint. Other pairs collide,
/// except declared ones and near links that overlap by construction.
namespace verp::model {

/// At most this many joints apart: a hip's axes meet in one point, and the boxes around them
/// overlap.
inline constexpr int kNearJoints = 3;

struct Overlap {
  int link = 0, other = 0;  ///< nodes, link < other
  double depth_m = 0;
};

/// Links that overlap at these angles, without neighbours.
std::vector<Overlap> overlaps(const Entity& entity, const std::vector<double>& joint_rad);

/// Number of joints between two links; kMaxJoints if neither carries the other.
int joints_between(const Entity& entity, int link, int other);

struct Clash {
  Overlap overlap;
  const char* pose;
};

/// Adds near links that overlap at the zero, standing or sitting pose to entity.no_collide. Returns
/// other undeclared overlaps: such a robot would push itself apart.
std::vector<Clash> find_near_overlaps(Entity& entity);

}  // namespace verp::model
