#include "host/twin/sim/truth.hpp"

#include <algorithm>
#include <cmath>

namespace verp::sim {

void FootLoads::add(const Vec3& position_world_m, const Vec3& force_world_n) {
  force_n_ += force_world_n.z();
  // Penetration moves the points off the plane: friction has a small lever.
  moment_n_m_ += force_world_n.z() * position_world_m.head<2>() -
                 position_world_m.z() * force_world_n.head<2>();
}

void FootLoads::add(const FootLoads& other) {
  force_n_ += other.force_n_;
  moment_n_m_ += other.moment_n_m_;
}

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  if (points.size() < 3) return points;
  const auto left_turn = [](const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()) > 0;
  };
  std::vector<Vec2> hull;
  const auto extend = [&](const Vec2& point, std::size_t floor) {
    while (hull.size() >= floor + 2 && !left_turn(hull[hull.size() - 2], hull.back(), point))
      hull.pop_back();
    hull.push_back(point);
  };
  for (const Vec2& point : points) extend(point, 0);
  hull.pop_back();
  const std::size_t lower = hull.size();
  for (auto point = points.rbegin(); point != points.rend(); ++point) extend(*point, lower);
  hull.pop_back();
  return hull;
}

Vec3 roll_pitch_yaw(const Mat3& rotation) {
  return {std::atan2(rotation(2, 1), rotation(2, 2)),
          std::atan2(-rotation(2, 0), std::hypot(rotation(2, 1), rotation(2, 2))),
          std::atan2(rotation(1, 0), rotation(0, 0))};
}

}  // namespace verp::sim
