#include "common/safety/limit.hpp"

#include "common/math/convert.hpp"
#include "common/math/spline.hpp"
#include "common/model/coupling.hpp"

namespace verp::safety {
namespace {

constexpr float kLongestWay_s = 65;

float inside(const JointParams& joint, float angle_rad) {
  return math::clamp(angle_rad, joint.lower_rad, joint.upper_rad);
}

// Takes twice the mean speed: minimum jerk peaks at 15/8 of its mean; the stand may move meanwhile.
std::uint16_t time_for_way(const Params& params, const LimitState& state, const LimitIn& in) {
  const bool sitting = in.mode == Mode::kSitting;
  float longest_s = sitting ? in.tuning->sit_s : in.tuning->rise_s;
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    const float end_rad = inside(joint, sitting ? joint.sit_rad : in.wanted_rad[j]);
    const float way_rad = math::abs(end_rad - state.goal_rad[j]);
    longest_s = math::max(longest_s, 2.0F * way_rad / joint.velocity_limit_rad_s);
  }
  return static_cast<std::uint16_t>(math::to_int32(1e3F * math::min(longest_s, kLongestWay_s)));
}

// The whole way is a minimum-jerk curve, even if its end moves.
float blend(const Params& params, std::int32_t in_mode_us, std::uint16_t way_ms) {
  const float duration_s = 1e-3F * math::to_float(std::int32_t{way_ms > 0 ? way_ms : 1});
  const float now_s = static_cast<float>(in_mode_us) * 1e-6F;
  const float period_s = static_cast<float>(params.period_us) * 1e-6F;
  const auto way = [&](float time_s) {
    return math::minimum_jerk(math::clamp(time_s / duration_s, 0.0F, 1.0F)).value;
  };
  const float left = 1.0F - way(now_s - period_s);
  return left > 1e-6F ? math::clamp((way(now_s) - way(now_s - period_s)) / left, 0.0F, 1.0F) : 1.0F;
}

}  // namespace

int joint_beyond(const Params& params, const std::int32_t* position_count) {
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    const float angle_rad = model::angle_of(joint, position_count[j]);
    if (math::abs(angle_rad - inside(joint, angle_rad)) > kBeyond_rad) return j;
  }
  return kMaxJoints;
}

LimitOut limit(const Params& params, LimitState& state, const LimitIn& in) {
  if (!has_torque(in.mode)) {
    for (int j = 0; j < params.joint_count; ++j) {
      const JointParams& joint = params.joint[j];
      state.goal_rad[j] = inside(joint, model::angle_of(joint, in.position_count[j]));
    }
    return {.beyond = joint_beyond(params, in.position_count) < kMaxJoints, .way_ms = in.way_ms};
  }
  if (in.mode == Mode::kHolding) return {.way_ms = in.way_ms};
  const float period_s = static_cast<float>(params.period_us) * 1e-6F;
  const bool sitting = in.mode == Mode::kSitting;
  const bool blending = in.mode == Mode::kRising || sitting;
  LimitOut out{.way_ms = in.way_ms};
  if (blending && in.in_mode_us == 0) out.way_ms = time_for_way(params, state, in);
  const float share = blending ? blend(params, in.in_mode_us, out.way_ms) : 1.0F;
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    const float inside_rad = inside(joint, sitting ? joint.sit_rad : in.wanted_rad[j]);
    const float most_rad = joint.velocity_limit_rad_s * period_s;
    const float move_rad = share * (inside_rad - state.goal_rad[j]);
    if (move_rad > most_rad || move_rad < -most_rad) {
      state.goal_rad[j] += math::copysign(most_rad, move_rad);
      out.slowed = out.slowed || !blending;
    } else {
      state.goal_rad[j] = blending ? state.goal_rad[j] + move_rad : inside_rad;
    }
  }
  model::lead(params, state.goal_rad);
  return out;
}

}  // namespace verp::safety
