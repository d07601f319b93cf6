#include "common/safety/limit.hpp"

#include "common/math/spline.hpp"
#include "common/model/counts.hpp"

namespace verp::safety {
namespace {

// Share of what is left to go that this tick takes, so that the whole way is a minimum-jerk curve
// wherever it began and however its end moves meanwhile.
float blend(const Params& params, std::int32_t in_mode_us, float duration_s) {
  const float now_s = static_cast<float>(in_mode_us) * 1e-6F;
  const float period_s = static_cast<float>(params.period_us) * 1e-6F;
  const auto way = [&](float time_s) {
    return math::minimum_jerk(math::clamp(time_s / duration_s, 0.0F, 1.0F)).value;
  };
  const float left = 1.0F - way(now_s - period_s);
  return left > 1e-6F ? math::clamp((way(now_s) - way(now_s - period_s)) / left, 0.0F, 1.0F) : 1.0F;
}

}  // namespace

bool limit(const Params& params, LimitState& state, const LimitIn& in) {
  if (!has_torque(in.mode)) {
    for (int j = 0; j < params.joint_count; ++j) {
      const JointParams& joint = params.joint[j];
      state.goal_rad[j] = math::clamp(model::angle_of(joint, in.position_count[j]), joint.lower_rad,
                                      joint.upper_rad);
    }
    return false;
  }
  if (in.mode == Mode::kHolding) return false;
  const float period_s = static_cast<float>(params.period_us) * 1e-6F;
  const bool rising = in.mode == Mode::kRising;
  const bool sitting = in.mode == Mode::kSitting;
  const bool blending = rising || sitting;
  const float share =
      blending ? blend(params, in.in_mode_us, rising ? in.tuning->rise_s : in.tuning->sit_s) : 1.0F;
  bool slowed = false;
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    const float inside_rad =
        math::clamp(sitting ? joint.sit_rad : in.wanted_rad[j], joint.lower_rad, joint.upper_rad);
    const float most_rad = joint.velocity_limit_rad_s * period_s;
    const float move_rad = share * (inside_rad - state.goal_rad[j]);
    if (move_rad > most_rad || move_rad < -most_rad) {
      state.goal_rad[j] += math::copysign(most_rad, move_rad);
      slowed = slowed || !blending;
    } else {
      state.goal_rad[j] = blending ? state.goal_rad[j] + move_rad : inside_rad;
    }
  }
  return slowed;
}

}  // namespace verp::safety
