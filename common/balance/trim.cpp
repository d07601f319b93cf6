#include "common/balance/trim.hpp"

#include "common/math/convert.hpp"
#include "common/model/tree.hpp"

namespace verp::balance {
namespace {

constexpr float kLoaded = 0.4F;  // share of the weight above which the pressure says something

void adjust(float change_rad, float& trim_rad) {
  trim_rad = math::clamp(trim_rad + change_rad, -kMaxTrim_rad, kMaxTrim_rad);
}

float total(const std::uint16_t* count) {
  return math::to_float(std::int32_t{count[0]} + count[1] + count[2] + count[3]);
}

}  // namespace

gait::Xy pressure_center(const std::uint16_t* foot_count) {
  const std::int32_t front_left = foot_count[0], front_right = foot_count[1];
  const std::int32_t back_left = foot_count[2], back_right = foot_count[3];
  const float sum = total(foot_count);
  if (!(sum > 0.0F)) return {};
  return {math::to_float(front_left + front_right - back_left - back_right) / sum,
          math::to_float(front_left + back_left - front_right - back_right) / sum};
}

void learn(const Params& params, const Tuning& tuning, const AttitudeOut& attitude,
           const TrimIn& in, TrimState& state) {
  if (!(tuning.balance.trim_time_s > 0.0F)) return;
  const float share = in.period_s / tuning.balance.trim_time_s;
  LegCorrection& trim = state.leg[in.carrying];
  adjust(share * attitude.roll_rad, trim.hip_roll_rad);
  adjust(share * (attitude.pitch_rad - in.planned_pitch_rad), trim.hip_pitch_rad);

  const float weight_n = model::total_mass(params) * math::kGravityMS2;
  const float load_n = total(in.foot_count) * params.feet.newton_per_count;
  if (!in.feet_fresh || load_n < kLoaded * weight_n) return;
  const LegParams& leg = params.leg[in.carrying];
  const gait::Xy center = pressure_center(in.foot_count);
  const float out = in.carrying == gait::kLeft ? 1.0F : -1.0F;
  const float ahead_m =
      center.x * 0.5F * (leg.sole_front_m + leg.sole_back_m) - tuning.gait.zmp_x_m;
  const float left_m =
      center.y * 0.5F * (leg.sole_left_m + leg.sole_right_m) - out * tuning.gait.zmp_y_m;
  // Turning the sole by an angle moves the pressure by angle / (weight times the ankle's
  // compliance).
  const auto turn_rad = [&](int k, float off_m) {
    return share * off_m * weight_n * params.joint[leg.joint[k]].compliance_rad_nm;
  };
  adjust(-turn_rad(4, ahead_m), trim.ankle_pitch_rad);
  adjust(turn_rad(5, left_m), trim.ankle_roll_rad);
}

}  // namespace verp::balance
