#include "host/author/action/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "common/action/player.hpp"
#include "common/kinematics/forward.hpp"
#include "common/math/linear.hpp"
#include "common/model/leg.hpp"
#include "common/model/tree.hpp"
#include "host/robot/model/self_collision.hpp"

namespace verp::action {
namespace {

using Torques = std::array<double, kMaxJoints>;

/// Carrying soles stand level.
class Support {
 public:
  explicit Support(const Params& params) : params_(params) {}

  /// Torques against weight alone, N m.
  Torques torques(const PlayerOut& now) const;
  /// The centre of mass relative to a standing sole: x and y in its frame, z above.
  Vec3 com_over(const PlayerOut& now, int side) const;
  /// Distance inside the carrying soles of a point in that sole's frame; negative outside.
  double margin_m(const PlayerOut& now, int side, const Vec2& point_m) const;

 private:
  Pose sole(const PlayerOut& now, int side) const;

  const Params& params_;
};

float cross2(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Counter-clockwise (Andrew's monotone chain).
std::vector<Vec2> hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vec2> around;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t first = around.size();
    for (const Vec2& point : points) {
      while (around.size() >= first + 2 &&
             cross2(around.back() - around[around.size() - 2], point - around.back()) <= 0) {
        around.pop_back();
      }
      around.push_back(point);
    }
    around.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return around;
}

std::array<Vec3, 4> corners(const LegParams& leg) {
  return {Vec3(leg.sole_front_m, leg.sole_left_m, 0), Vec3(leg.sole_front_m, -leg.sole_right_m, 0),
          Vec3(-leg.sole_back_m, leg.sole_left_m, 0), Vec3(-leg.sole_back_m, -leg.sole_right_m, 0)};
}

Pose Support::sole(const PlayerOut& now, int side) const {
  const LegParams& leg = params_.leg[side];
  float leg_rad[kLegJoints];
  model::read_leg(leg, now.angle_rad, leg_rad);
  return kinematics::sole_pose(leg, kinematics::leg_chain(params_, leg, Pose{}, leg_rad));
}

Vec3 Support::com_over(const PlayerOut& now, int side) const {
  const Vec3 com_m = kinematics::center_of_mass(params_, Pose{}, now.angle_rad);
  return math::apply(math::inverse(sole(now, side)), com_m);
}

double Support::margin_m(const PlayerOut& now, int side, const Vec2& point_m) const {
  std::vector<Vec2> points;
  const Pose from = math::inverse(sole(now, side));
  for (int foot = 0; foot < kFeet; ++foot) {
    if (now.stance != Stance::kBoth && foot != static_cast<int>(now.stance)) continue;
    const Pose there = from * sole(now, foot);
    for (const Vec3& corner : corners(params_.leg[foot])) {
      const Vec3 at = math::apply(there, corner);
      points.emplace_back(at.x(), at.y());
    }
  }
  const std::vector<Vec2> around = hull(points);
  double margin = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Vec2 edge = around[(i + 1) % around.size()] - around[i];
    const double length = std::hypot(edge.x(), edge.y());
    margin = std::min(margin, cross2(edge, point_m - around[i]) / std::max(length, 1e-6));
  }
  return margin;
}

Torques Support::torques(const PlayerOut& now) const {
  std::array<Pose, kMaxNodes> node;
  kinematics::all_poses(params_, Pose{}, now.angle_rad, node.data());
  const Pose soles[kFeet] = {sole(now, 0), sole(now, 1)};
  const Vec3 up = math::normalized_or(
      now.carry[0] * soles[0].rotation.col(2) + now.carry[1] * soles[1].rotation.col(2),
      Vec3(0, 0, 1));
  const Vec3 com_m = kinematics::center_of_mass(params_, Pose{}, now.angle_rad);
  const float push_n = model::total_mass(params_) * math::kGravityMS2;
  Torques torques{};
  for (int j = 0; j < params_.joint_count; ++j) {
    const std::uint32_t beyond = model::subtree(params_, j + 1) | 1U << j;
    const Vec3 at_m = node[static_cast<std::size_t>(j) + 1].position_m;
    Vec3 moment = Vec3::Zero();
    for (int i = 0; i < params_.joint_count; ++i) {
      if ((beyond >> i & 1U) == 0) continue;
      const Vec3 mass_m = math::apply(node[static_cast<std::size_t>(i) + 1],
                                      math::to_vec(params_.joint[i].com_link_m));
      const Vec3 weight_n = -math::kGravityMS2 * params_.joint[i].mass_kg * up;
      moment += math::cross(mass_m - at_m, weight_n);
    }
    for (int foot = 0; foot < kFeet; ++foot) {
      const LegParams& leg = params_.leg[foot];
      if (leg.solver == LegSolver::kNone || (beyond >> model::last_joint(leg) & 1U) == 0) {
        continue;
      }
      // The ground pushes below the centre of mass if the foot carries alone, else at the sole's
      // middle.
      const Vec3 below_m = com_m - (com_m - soles[foot].position_m).dot(up) * up;
      const Vec3 ground_m = now.stance == Stance::kBoth ? soles[foot].position_m : below_m;
      moment += math::cross(ground_m - at_m, now.carry[foot] * push_n * up);
    }
    const Vec3 axis =
        kinematics::joint_axis(params_.joint[j], node[static_cast<std::size_t>(j) + 1].rotation);
    torques[static_cast<std::size_t>(j)] = axis.dot(moment);
  }
  return torques;
}

constexpr int kMostTicks = 60000;
constexpr int kCollideEvery = 5;  // ticks
constexpr double kMostTorqueShare = 0.9;
constexpr double kLeastMargin_m = -0.005;  // the balance can take this
constexpr double kTouch_m = 1e-3;          // contact depth of resting links

void fulfil(Condition condition, PlayerIn& in) {
  constexpr float kQuarter = 1.5707963F;
  const bool lies = condition >= Condition::kLiesFront && condition <= Condition::kLiesRight;
  in.up = lies ? 0 : 1;
  in.pitch_rad = condition == Condition::kLiesFront  ? kQuarter
                 : condition == Condition::kLiesBack ? -kQuarter
                                                     : 0;
  in.roll_rad = condition == Condition::kLiesRight  ? kQuarter
                : condition == Condition::kLiesLeft ? -kQuarter
                                                    : 0;
  in.pressed[0] = condition != Condition::kRightFoot && condition != Condition::kNoFoot;
  in.pressed[1] = condition != Condition::kLeftFoot && condition != Condition::kNoFoot;
}

class Checker {
 public:
  Checker(const model::Entity& entity, const Params& params, const CompiledActions& made)
      : entity_(entity), params_(params), made_(made), support_(params), stand_(params) {}

  ActionCheck run(int number) {
    const Library library = made_.library();
    const bool stays = number == library.number_of(kLieDown);  // it does not return to the stand
    PlayerState state;
    PlayerIn in;
    in.asked = static_cast<std::uint8_t>(number);
    in.may_begin = true;
    in.period_us = static_cast<std::int32_t>(params_.period_us);
    in.stand_rad = stand_.stand_rad().data();
    for (tick_ = 0; tick_ < kMostTicks; ++tick_) {
      if (state.number != 0) fulfil(library.frame(state.frame).condition, in);
      const PlayerOut out = update(params_, library, state, in);
      if (state.number == 0 || (stays && state.part == Part::kReturn)) break;
      enter(state.part == Part::kReturn ? -1 : state.frame);
      look(out);
      before_ = out;
    }
    result_.length_s = time_s();
    result_.whole = tick_ < kMostTicks;
    return std::move(result_);
  }

 private:
  double period_s() const { return 1e-6 * params_.period_us; }
  double time_s() const { return tick_ * period_s(); }

  void enter(int frame) {
    if (!result_.frames.empty() && result_.frames.back().frame == frame && frame == frame_) {
      result_.frames.back().end_s = time_s();
      return;
    }
    frame_ = frame;
    FrameCheck check;
    check.frame = frame;
    check.line = frame < 0 ? 0 : made_.line[static_cast<std::size_t>(frame)];
    check.begin_s = check.end_s = time_s();
    result_.frames.push_back(check);
  }

  void blame(const std::string& problem) {
    FrameCheck& now = result_.frames.back();
    if (now.problem.empty()) now.problem = problem;
  }

  void look(const PlayerOut& out) {
    for (int j = 0; j < params_.joint_count; ++j) look_at_joint(out, j);
    if (tick_ % kCollideEvery == 0) look_at_collisions(out);
    look_at_weight(out);
    look_at_zmp(out);
  }

  void look_at_joint(const PlayerOut& out, int j) {
    constexpr float kRounding_rad = 2e-3F, kDegrees = 57.29578F;
    const JointParams& joint = params_.joint[j];
    const float angle = out.angle_rad[j];
    if (angle < joint.lower_rad - kRounding_rad || angle > joint.upper_rad + kRounding_rad) {
      blame(fmt::format("joint '{}' at {:.1f} degrees is beyond its limits of {:.1f} to {:.1f}",
                        joint.name, kDegrees * angle, kDegrees * joint.lower_rad,
                        kDegrees * joint.upper_rad));
    }
    if (!before_) return;
    const double speed = std::abs(angle - before_->angle_rad[j]) / period_s();
    const double share = speed / joint.velocity_limit_rad_s;
    FrameCheck& now = result_.frames.back();
    if (share > now.speed_share) now.speed_share = share, now.fastest = joint.name;
    if (share > 1) {
      blame(fmt::format("joint '{}' turns at {:.1f} rad/s, its limit is {:.1f}: give it more time",
                        joint.name, speed, joint.velocity_limit_rad_s));
    }
  }

  void look_at_collisions(const PlayerOut& out) {
    const std::vector<double> joint_rad(out.angle_rad, out.angle_rad + params_.joint_count);
    for (const model::Overlap& overlap : model::overlaps(entity_, joint_rad)) {
      const bool allowed = std::any_of(
          entity_.no_collide.begin(), entity_.no_collide.end(), [&](const model::NoCollide& pair) {
            return pair.link == overlap.link && pair.other == overlap.other;
          });
      if (allowed || overlap.depth_m < kTouch_m) continue;
      const auto name = [&](int node) {
        return entity_.nodes[static_cast<std::size_t>(node)].name;
      };
      blame(fmt::format("links '{}' and '{}' meet, {:.1f} mm deep", name(overlap.link),
                        name(overlap.other), 1e3 * overlap.depth_m));
    }
  }

  void look_at_weight(const PlayerOut& out) {
    if (out.stance == Stance::kNone) return;  // the ground forces are unknown
    const Torques torques = support_.torques(out);
    FrameCheck& now = result_.frames.back();
    for (int j = 0; j < params_.joint_count; ++j) {
      const double stall = entity_.joints[static_cast<std::size_t>(j)].servo.stall_torque_n_m;
      const double share = std::abs(torques[static_cast<std::size_t>(j)]) / stall;
      if (share > now.torque_share) now.torque_share = share, now.hardest = params_.joint[j].name;
      if (share > kMostTorqueShare) {
        blame(fmt::format("joint '{}' has to hold {:.1f} N m, its servo's stall torque is {:.1f}",
                          params_.joint[j].name, share * stall, stall));
      }
    }
  }

  void look_at_zmp(const PlayerOut& out) {
    const bool carried = out.stance != Stance::kNone;
    // Accelerations need one reference foot.
    const int reference = out.carry[0] >= 0.5F ? 0 : 1;
    if (!carried || reference != reference_) com_m_.clear();
    reference_ = reference;
    if (!carried) return;
    com_m_.push_back(support_.com_over(out, reference));
    if (com_m_.size() < 3) return;
    if (com_m_.size() > 3) com_m_.erase(com_m_.begin());
    const Vec3 accel =
        (com_m_[2] - 2 * com_m_[1] + com_m_[0]) / static_cast<float>(period_s() * period_s());
    const float lever_s2 = com_m_[1].z() / (math::kGravityMS2 + accel.z());
    const Vec2 zmp_m{com_m_[1].x() - lever_s2 * accel.x(), com_m_[1].y() - lever_s2 * accel.y()};
    const double margin = support_.margin_m(out, reference, zmp_m);
    FrameCheck& now = result_.frames.back();
    now.zmp_margin_m = std::min(now.zmp_margin_m, margin);
    if (margin < kLeastMargin_m) {
      blame(
          fmt::format("the ZMP is {:.0f} mm outside of the soles that carry: slower, or the "
                      "body further over the foot",
                      -1e3 * margin));
    }
  }

  const model::Entity& entity_;
  const Params& params_;
  const CompiledActions& made_;
  Support support_;
  Poser stand_;
  ActionCheck result_;
  int tick_ = 0, frame_ = -2, reference_ = -1;
  std::optional<PlayerOut> before_;
  std::vector<Vec3> com_m_;
};

}  // namespace

const FrameCheck* ActionCheck::first_bad() const {
  const auto bad = std::find_if(frames.begin(), frames.end(),
                                [](const FrameCheck& each) { return !each.problem.empty(); });
  return bad == frames.end() ? nullptr : &*bad;
}

ActionCheck check(const model::Entity& entity, const Params& params, const CompiledActions& made,
                  int number) {
  return Checker(entity, params, made).run(number);
}

}  // namespace verp::action
