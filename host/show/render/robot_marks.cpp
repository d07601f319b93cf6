#include <cmath>

#include "host/show/render/marks.hpp"

namespace verp::render {

using scene::Colour;
using scene::RobotView;
using scene::Vec2;
using scene::Vec3;

namespace {

constexpr Colour kMeasured{0.90F, 0.22F, 0.15F, 1}, kPlanned{0.10F, 0.45F, 0.85F, 1};
constexpr Colour kCom{0.98F, 0.78F, 0.12F, 1}, kForce{0.16F, 0.62F, 0.34F, 1};
constexpr Colour kSupport{0.16F, 0.62F, 0.34F, 0.30F}, kSupportEdge{0.10F, 0.48F, 0.26F, 0.9F};
constexpr Colour kLeft{0.10F, 0.45F, 0.85F, 0.75F}, kRight{0.80F, 0.30F, 0.62F, 0.75F};
constexpr Colour kRay{0.92F, 0.16F, 0.14F, 0.75F};
constexpr double kOver_m = 0.0015;  // marks lie so far above the floor and each other

class RobotMarks {
 public:
  RobotMarks(Marks& marks, const scene::Robot& robot, const RobotView& view)
      : marks_(marks), robot_(robot), view_(view), unit_m_(robot.height_m / 0.45) {}

  void axes() {
    const double length_m = 0.045 * unit_m_, radius_m = 0.0012 * unit_m_;
    const Colour colours[] = {
        {0.85F, 0.2F, 0.2F, 1}, {0.2F, 0.7F, 0.25F, 1}, {0.2F, 0.4F, 0.9F, 1}};
    for (const auto& link : view_.link_world) {
      for (int i = 0; i < 3; ++i) {
        marks_.arrow(link.translation(), link.translation() + length_m * link.linear().col(i),
                     radius_m, colours[i]);
      }
    }
  }

  void com() {
    if (!view_.com_world_m) return;
    const Vec3& at_m = *view_.com_world_m;
    marks_.ball(at_m, 0.011 * unit_m_, kCom);
    marks_.rod(at_m, {at_m.x(), at_m.y(), 2 * kOver_m}, 0.0012 * unit_m_, kCom);
    marks_.disc(at_m.head<2>(), 3 * kOver_m, 0.007 * unit_m_, 0.0035 * unit_m_, kCom);
  }

  void zmp() {
    if (view_.zmp_planned_world_m) {
      marks_.disc(*view_.zmp_planned_world_m, 4 * kOver_m, 0.0115 * unit_m_, 0.0075 * unit_m_,
                  kPlanned);
    }
    if (view_.zmp_world_m) {
      marks_.disc(*view_.zmp_world_m, 5 * kOver_m, 0.0065 * unit_m_, 0, kMeasured);
    }
  }

  void support() {
    if (view_.support_world_m.size() < 3) return;
    marks_.area(view_.support_world_m, kOver_m, kSupport);
    marks_.outline(view_.support_world_m, 1.5 * kOver_m, 0.0025 * unit_m_, kSupportEdge);
  }

  /// An arrow of a third of the robot's height is its weight.
  void contacts() {
    double weight_n = 0;
    for (const auto& node : robot_.entity->nodes) weight_n += 9.81 * node.mass_kg;
    if (weight_n <= 0) return;
    for (const scene::ContactForce& contact : view_.contacts) {
      if (contact.force_world_n.norm() < 0.01 * weight_n) continue;
      marks_.arrow(
          contact.position_world_m,
          contact.position_world_m + contact.force_world_n * (robot_.height_m / 3 / weight_n),
          0.0028 * unit_m_, kForce);
    }
  }

  void footsteps() {
    double height_m = 1.8 * kOver_m;
    for (const scene::Footstep& step : view_.footsteps) {
      const std::vector<Vec2> corners = sole_at(step);
      if (corners.empty()) continue;
      marks_.outline(corners, height_m, 0.003 * unit_m_, step.side == 0 ? kLeft : kRight);
      height_m += 0.0002;
    }
  }

 private:
  std::vector<Vec2> sole_at(const scene::Footstep& step) const {
    for (const model::Limb& limb : robot_.entity->limbs) {
      if (limb.name != (step.side == 0 ? "left_leg" : "right_leg")) continue;
      std::vector<Vec2> corners;
      const Vec3 &low = limb.sole_min_m, &high = limb.sole_max_m;
      for (const Vec2& at : {Vec2(low.x(), low.y()), Vec2(high.x(), low.y()),
                             Vec2(high.x(), high.y()), Vec2(low.x(), high.y())}) {
        corners.push_back(step.at_world_m + Eigen::Rotation2Dd(step.yaw_rad) * at);
      }
      return corners;
    }
    return {};
  }

  Marks& marks_;
  const scene::Robot& robot_;
  const RobotView& view_;
  const double unit_m_;
};

}  // namespace

Effects Effects::explained() {
  Effects effects;
  effects.com = effects.zmp = effects.support = effects.contacts = true;
  effects.footsteps = effects.trails = effects.rays = true;
  return effects;
}

Marks marks_of(const scene::Scene& scene, const scene::Snapshot& now, const Effects& effects) {
  Marks marks;
  const std::size_t robots = std::min(scene.robots.size(), now.robots.size());
  for (std::size_t r = 0; r < robots; ++r) {
    RobotMarks robot(marks, scene.robots[r], now.robots[r]);
    if (effects.axes) robot.axes();
    if (effects.support) robot.support();
    if (effects.footsteps) robot.footsteps();
    if (effects.com) robot.com();
    if (effects.zmp) robot.zmp();
    if (effects.contacts) robot.contacts();
  }
  for (const scene::Trail& trail : now.trails) {
    for (std::size_t i = 1; effects.trails && i < trail.points_world_m.size(); ++i) {
      marks.rod(trail.points_world_m[i - 1], trail.points_world_m[i], 0.0016, trail.colour);
    }
  }
  for (const scene::Ray& ray : now.rays) {
    if (!effects.rays) break;
    marks.rod(ray.from_world_m, ray.to_world_m, 0.0007, kRay);
    if (ray.hit) marks.ball(ray.to_world_m, 0.004, kRay);
  }
  return marks;
}

}  // namespace verp::render
