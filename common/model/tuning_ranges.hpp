#pragma once
#include "common/math/scalar.hpp"
#include "common/model/tuning.hpp"

/// In field order. Inside these ranges plans are finite and bounded in time; the robot may still
/// fall.
namespace verp {

struct Range {
  float low;
  float high;
};

inline constexpr Range kTuningRanges[] = {
    // gait
    {0.30F, 2.0F},    // cycle_s
    {0.0F, 0.6F},     // double_support
    {0.0F, 0.06F},    // lift_m
    {0.015F, 0.15F},  // half_stance_m
    {0.05F, 1.0F},    // hip_height_m
    {-0.4F, 0.4F},    // trunk_pitch_rad
    {-0.05F, 0.05F},  // zmp_x_m
    {-0.05F, 0.05F},  // zmp_y_m
    {0.0F, 0.02F},    // touchdown_m
    {0.0F, 0.3F},     // max_step_m
    {0.0F, 0.6F},     // max_turn_rad
    {0.001F, 0.1F},   // step_change_m
    {0.1F, 2.0F},     // start_s
    {0.0F, 0.030F},   // joint_delay_s
    {0.0F, 0.060F},   // look_ahead_s
    {0.0F, 0.03F},    // support_margin_m
    {0.0F, 1.0F},     // heading_gain
    {0.0F, 0.03F},    // haste_lift_m
    // balance
    {0.0F, 1.0F},   // gravity_enable
    {0.0F, 2.0F},   // inertia_share
    {0.0F, 2.0F},   // friction_share
    {0.0F, 1.0F},   // multibody_enable
    {0.0F, 1.0F},   // feedback_enable
    {0.0F, 1.0F},   // zeros_enable
    {-2.0F, 2.0F},  // ankle_pitch_tilt
    {-0.5F, 0.5F},  // ankle_pitch_rate_s
    {-2.0F, 2.0F},  // ankle_roll_tilt
    {-0.5F, 0.5F},  // ankle_roll_rate_s
    {-2.0F, 2.0F},  // hip_pitch_tilt
    {-0.5F, 0.5F},  // hip_pitch_rate_s
    {-2.0F, 2.0F},  // hip_roll_tilt
    {-0.5F, 0.5F},  // hip_roll_rate_s
    {-2.0F, 2.0F},  // swing_level
    {0.0F, 0.6F},   // feedback_limit_rad
    {0.0F, 2.0F},   // arm_swing
    // safety
    {0.2F, 1.5F},     // fall_tilt_rad
    {0.0F, 1.0F},     // fall_confirm_s
    {0.01F, 1.0F},    // stale_hold_s
    {0.05F, 1.0F},    // stale_release_s: ages count up to 255 ticks
    {0.05F, 60.0F},   // command_hold_s
    {0.1F, 3600.0F},  // command_release_s
    {0.2F, 10.0F},    // rise_s
    {0.2F, 10.0F},    // sit_s
    {0.0F, 60.0F},    // voltage_low_v
    {30.0F, 120.0F},  // temperature_high_c
    {0.3F, 3600.0F},  // unloaded_s
};
static_assert(sizeof(kTuningRanges) / sizeof(Range) == kTuningCount,
              "one range for each field of Tuning");

/// False for NaN too.
constexpr bool in_range(int id, float value) {
  return id >= 0 && id < kTuningCount && value >= kTuningRanges[id].low &&
         value <= kTuningRanges[id].high;
}

/// A Tuning as an array, indexed by parameter id.
inline float tuning_value(const Tuning& tuning, int id) {
  float value;
  __builtin_memcpy(&value, reinterpret_cast<const unsigned char*>(&tuning) + 4 * id, 4);
  return value;
}
inline void set_tuning_value(Tuning& tuning, int id, float value) {
  __builtin_memcpy(reinterpret_cast<unsigned char*>(&tuning) + 4 * id, &value, 4);
}

}  // namespace verp
