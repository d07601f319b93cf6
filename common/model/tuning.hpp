#pragma once
#include "common/base/fields.hpp"

/// Numbers that may change while the robot runs: Params holds the robot's own, State those in
/// force. One parameter write a tick (Inputs::parameter_id: index in this list) changes State, if
/// inside tuning_ranges.hpp. All are float32.
namespace verp {

/// A cycle is two steps, 16 states joined by 15 intervals (paper). Defaults: generic21, tuning
/// seeds 1001-1024, checked on 1031-1040. Robots' files override them.
struct GaitTuning {
  float cycle_s = 0.450f;         ///< two steps; interval cycle_s / 15
  float double_support = 0.006f;  ///< share of a step with both feet on the ground
  float lift_m = 0.0119f;         ///< height of the swing sole at mid-swing
  float half_stance_m = 0.0356f;  ///< lateral, from the midline to each foot's centre
  float hip_height_m = 0.1503f;   ///< hip centre above the ankle axes
  float trunk_pitch_rad = 0.03f;  ///< positive is nose down
  float zmp_x_m = -0.000206f;     ///< ZMP reference, sole frame, forward
  float zmp_y_m = 0.0022f;        ///< ZMP reference, outward from the midline
  float touchdown_m = 0.0053f;    ///< target height of the swing sole at landing
  float max_step_m = 0.095f;      ///< longest step: one foot past the other, any direction
  float max_turn_rad = 0.40f;     ///< largest turn per step
  float step_change_m = 0.010f;   ///< largest change of step length between two steps
  float start_s = 0.4f;           ///< start phase: ZMP moves to the first stance foot
  /// Joint k of a limb lags by k times this (paper: 0.030), by at most 12 key points. Defaults are
  /// tuned for 0 and walk with up to 0.020; with 0.030 the robot falls.
  float joint_delay_s = 0.0f;
  float look_ahead_s = 0.0213f;     ///< goals are for this much later: bus and servo delay
  float support_margin_m = 0.004f;  ///< least distance of the planned ZMP from the sole's edge
  /// Share of the heading error corrected in a step; 0 also makes all steps equally long.
  float heading_gain = 0.12f;
  float haste_lift_m = 0.005f;  ///< lift added per Step::haste
  VERP_FIELDS(cycle_s, double_support, lift_m, half_stance_m, hip_height_m, trunk_pitch_rad,
              zmp_x_m, zmp_y_m, touchdown_m, max_step_m, max_turn_rad, step_change_m, start_s,
              joint_delay_s, look_ahead_s, support_margin_m, heading_gain, haste_lift_m)
};
VERP_PACKED(GaitTuning);

/// Each `enable` is 1 or 0.
struct BalanceTuning {
  float gravity_enable = 1.0f;      ///< gravity feed-forward by the servos' compliance
  float inertia_share = 0.244f;     ///< share of the rotors' inertia fed forward
  float friction_share = 1.24f;     ///< share of the gears' friction fed forward
  float multibody_enable = 1.0f;    ///< multibody ZMP correction
  float feedback_enable = 1.0f;     ///< gyro and tilt feedback
  float zeros_enable = 1.0f;        ///< learnt zero errors and landings
  float ankle_pitch_tilt = -0.27f;  ///< rad per rad
  float ankle_pitch_rate_s = 0.0239f;
  float ankle_roll_tilt = -0.0145f;
  float ankle_roll_rate_s = 0.0406f;
  float hip_pitch_tilt = 0.2f;
  float hip_pitch_rate_s = 0.0169f;
  float hip_roll_tilt = -0.271f;
  float hip_roll_rate_s = 0.0401f;
  float swing_level = 0.61f;         ///< share of the tilt that the swing ankle undoes
  float feedback_limit_rad = 0.25f;  ///< largest correction of any joint
  float arm_swing = 0.6f;            ///< share of the legs' spin that arms cancel
  VERP_FIELDS(gravity_enable, inertia_share, friction_share, multibody_enable, feedback_enable,
              zeros_enable, ankle_pitch_tilt, ankle_pitch_rate_s, ankle_roll_tilt,
              ankle_roll_rate_s, hip_pitch_tilt, hip_pitch_rate_s, hip_roll_tilt, hip_roll_rate_s,
              swing_level, feedback_limit_rad, arm_swing)
};
VERP_PACKED(BalanceTuning);

struct SafetyTuning {
  float fall_tilt_rad = 0.8f;        ///< beyond this tilt the robot has fallen: limp
  float fall_confirm_s = 0.05f;      ///< for how long that tilt must last
  float stale_hold_s = 0.05f;        ///< servo or IMU silent this long: stop the gait, hold
  float stale_release_s = 0.5f;      ///< silent this long: sit, then release torque
  float command_hold_s = 0.5f;       ///< operator silent this long: walk becomes stand
  float command_release_s = 30.0f;   ///< operator silent this long: sit, then release torque
  float rise_s = 1.0f;               ///< from the pose at power-up to the stand
  float sit_s = 1.5f;                ///< from the held pose to the sitting pose
  float voltage_low_v = 9.6f;        ///< three lithium cells at 3.2 V
  float temperature_high_c = 72.0f;  ///< X-series shut down at 80 degrees
  float unloaded_s = 1.0f;           ///< feet carry nothing this long: sit, then release torque
  VERP_FIELDS(fall_tilt_rad, fall_confirm_s, stale_hold_s, stale_release_s, command_hold_s,
              command_release_s, rise_s, sit_s, voltage_low_v, temperature_high_c, unloaded_s)
};
VERP_PACKED(SafetyTuning);

struct Tuning {
  GaitTuning gait;
  BalanceTuning balance;
  SafetyTuning safety;
  VERP_FIELDS(gait, balance, safety)
};
VERP_PACKED(Tuning);

inline constexpr int kTuningCount = sizeof(Tuning) / sizeof(float);

}  // namespace verp
