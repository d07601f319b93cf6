#include "host/show/scene/trails.hpp"

#include "host/show/scene/measured.hpp"

namespace verp::scene {
namespace {

constexpr double kApart_m = 0.004;
constexpr std::size_t kMost = 1500;  // 6 m

void extend(Trail& trail, const Vec3& to_m) {
  auto& points = trail.points_world_m;
  if (!points.empty() && (points.back() - to_m).norm() < kApart_m) return;
  points.push_back(to_m);
  if (points.size() > kMost) points.erase(points.begin());
}

}  // namespace

void Trails::follow(Snapshot& now, const Entity& entity) {
  if (trails_.empty()) {
    trails_ = {{{0.98F, 0.78F, 0.12F, 1}, {}},
               {{0.10F, 0.45F, 0.85F, 1}, {}},
               {{0.80F, 0.30F, 0.62F, 1}, {}}};
  }
  if (!now.robots.empty()) {
    const RobotView& view = now.robots.front();
    if (view.com_world_m) extend(trails_[0], *view.com_world_m);
    const sim::Truth feet = soles_of(view, entity);
    for (std::size_t side = 0; side < 2; ++side) {
      if (feet.foot[side].present) extend(trails_[side + 1], feet.foot[side].centroid_world_m);
    }
  }
  now.trails = trails_;
}

}  // namespace verp::scene
