#include "host/study/identify/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/author/action/check.hpp"
#include "host/author/action/compile.hpp"
#include "host/robot/model/params.hpp"
#include "host/robot/model/self_collision.hpp"
#include "host/twin/sim/body.hpp"
#include "host/twin/sim/random.hpp"

namespace verp::identify {
namespace {

using Angles = std::vector<double>;

constexpr double kWay_s[] = {0.15, 0.25, 0.4, 0.7, 1.2};  ///< frame durations, in turn
constexpr double kRest_s = 0.3;                           ///< after the slowest frame
constexpr double kFar_rad = 0.7;                          ///< largest distance from the stand
constexpr double kFromStop_rad = 0.1;
// Shares of a joint's limits; other loads and weaker servos need the rest.
constexpr double kSpeedShare = 0.6, kTorqueShare = 0.3;
constexpr double kTopSpeed = 1.5, kTopAcceleration = 6;  ///< peaks of a cubic path of 1 in 1 s
constexpr int kLooks = 8;                                ///< collision checks along a path
constexpr double kApart_m = 0.02;  ///< clearance for model errors and curved paths
constexpr int kDraws = 20;
constexpr double kMostBeyond_s = 60;  ///< until the path to the stand is free

/// Inertia of all that a joint carries, in the standing pose.
std::vector<double> inertias_kg_m2(const model::Entity& entity, const Angles& stand) {
  const std::vector<model::Transform> pose =
      sim::link_poses(entity, model::Transform::Identity(), stand);
  std::vector<double> inertia(entity.joints.size());
  for (std::size_t n = entity.nodes.size(); n-- > 1;) {
    const model::Node& node = entity.nodes[n];
    const model::Vec3 com = pose[n] * node.com_m;
    const model::Mat3 own = pose[n].linear() * node.inertia_kg_m2 * pose[n].linear().transpose();
    for (std::size_t at = n; at != 0; at = static_cast<std::size_t>(entity.joints[at - 1].parent)) {
      const model::Vec3 axis = pose[at].linear() * entity.joints[at - 1].axis;
      const model::Vec3 arm = axis.cross(com - pose[at].translation());
      inertia[at - 1] += axis.dot(own * axis) + node.mass_kg * arm.squaredNorm();
    }
  }
  return inertia;
}

class Drawing {
 public:
  Drawing(const model::Entity& entity, const MotionOptions& options)
      : entity_(entity), wide_(widened(entity)), random_(options.seed, sim::Draw::kLyingPose) {
    for (const model::Joint& joint : entity.joints) stand_.push_back(joint.stand_rad);
    at_ = stand_;
    inertia_ = inertias_kg_m2(entity, stand_);
    for (const model::Overlap& each : model::overlaps(wide_, stand_)) {
      wide_.no_collide.push_back({each.link, each.other, {}});
    }
  }

  /// Draws the pose that the joints reach `way_s` from now.
  const Angles& next(double way_s) {
    double share = 1;
    for (int draw = 0; draw < kDraws; ++draw, share *= 0.85) {
      Angles to = at_;
      for (std::size_t j = 0; j < to.size(); ++j) to[j] = angle(j, way_s, share);
      lead(to);
      if (free(to)) return at_ = to;
    }
    return at_;
  }

  /// Is the path to the stand free?
  bool may_stand() const { return free(stand_); }
  const Angles& stand() { return at_ = stand_; }

 private:
  double angle(std::size_t j, double way_s, double share) {
    const model::Joint& joint = entity_.joints[j];
    const double torque_n_m = kTorqueShare * joint.servo.stall_torque_n_m;
    const double inertia = inertia_[j] + joint.servo.gearbox.armature_kg_m2;
    const double most =
        std::min({kFar_rad, kSpeedShare * joint.velocity_limit_rad_s * way_s / kTopSpeed,
                  torque_n_m / inertia * way_s * way_s / kTopAcceleration});
    const double middle = std::clamp(stand_[j], joint.lower_rad, joint.upper_rad);
    const double low = std::max(joint.lower_rad + kFromStop_rad, middle - share * kFar_rad);
    const double high = std::min(joint.upper_rad - kFromStop_rad, middle + share * kFar_rad);
    if (low >= high) return at_[j];
    const double to = low + (high - low) * 0.5 * (1 + random_.uniform(-1, 1));
    return std::clamp(to, at_[j] - most, at_[j] + most);
  }

  void lead(Angles& to) const {
    for (std::size_t j = 0; j < to.size(); ++j) {
      const model::Joint& joint = entity_.joints[j];
      if (joint.follows < 0) continue;
      to[j] = joint.ratio * to[static_cast<std::size_t>(joint.follows)] + joint.offset_rad;
    }
  }

  bool free(const Angles& to) const {
    for (int look = 1; look <= kLooks; ++look) {
      const double part = static_cast<double>(look) / kLooks;
      Angles angles = at_;
      for (std::size_t j = 0; j < to.size(); ++j) angles[j] += part * (to[j] - at_[j]);
      if (meet(entity_, angles) || meet(wide_, angles)) return false;
    }
    return true;
  }

  static model::Entity widened(model::Entity entity) {
    for (model::Node& node : entity.nodes) {
      for (model::Collision& shape : node.collisions) {
        shape.size_m += model::Vec3::Constant(kApart_m);
      }
    }
    return entity;
  }

  static bool meet(const model::Entity& entity, const Angles& angles) {
    for (const model::Overlap& each : model::overlaps(entity, angles)) {
      const auto exempt = [&](const model::NoCollide& pair) {
        return pair.link == each.link && pair.other == each.other;
      };
      if (std::none_of(entity.no_collide.begin(), entity.no_collide.end(), exempt)) return true;
    }
    return false;
  }

  const model::Entity& entity_;
  model::Entity wide_;  ///< thicker links, except those that meet in the stand
  sim::Random random_;
  Angles stand_, at_;
  std::vector<double> inertia_;
};

/// Joints that do not stop at a frame's end leave the checked straight path; where links then meet,
/// they must stop.
void straighten(const model::Entity& entity, action::Document& document) {
  constexpr double kStop_s = 0.02;
  const Params params = model::make_params(entity);
  const auto rest_at = [&](std::size_t frame) {
    double& hold_s = document.frames[frame].hold_s;
    const bool passed = hold_s < kStop_s;
    hold_s = std::max(hold_s, kStop_s);
    return passed;
  };
  for (bool changed = true; changed;) {
    changed = false;
    const action::CompiledActions made = action::make_library(params, {document});
    for (const action::FrameCheck& each : action::check(entity, params, made, 1).frames) {
      if (each.problem.empty() || each.frame < 0) continue;
      const auto at = static_cast<std::size_t>(each.frame);
      changed |= rest_at(at);
      if (at > 0) changed |= rest_at(at - 1);
    }
  }
}

}  // namespace

action::Document motion_of(const model::Entity& entity, const MotionOptions& options) {
  action::Document document;
  document.name = "identify";
  document.note = "All joints to and fro, the trunk in a stand: verp identify";
  Drawing drawing(entity, options);
  double time_s = 0;
  bool last = false;  // an action returns to the stand by itself
  for (std::size_t i = 0; !last && time_s < options.length_s + kMostBeyond_s; ++i) {
    const bool slow = i % std::size(kWay_s) == std::size(kWay_s) - 1;
    last = time_s >= options.length_s && slow && drawing.may_stand();
    action::FrameText frame;
    frame.time_s = kWay_s[i % std::size(kWay_s)];
    frame.hold_s = slow ? kRest_s : 0;
    if (i == 0) {
      frame.balance = false;
      frame.stance = action::Stance::kNone;
    }
    const Angles& to = last ? drawing.stand() : drawing.next(frame.time_s);
    for (std::size_t j = 0; j < to.size(); ++j) {
      if (entity.joints[j].follows >= 0) continue;
      frame.goals.push_back({entity.joints[j].name, false, to[j], 0});
    }
    time_s += frame.time_s + frame.hold_s;
    document.frames.push_back(std::move(frame));
  }
  straighten(entity, document);
  return document;
}

}  // namespace verp::identify
