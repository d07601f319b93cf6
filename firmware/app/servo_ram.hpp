#pragma once
#include <cstdint>

#include "common/model/counts.hpp"
#include "common/model/params.hpp"
#include "common/protocol/dynamixel2.hpp"

namespace verp::app {

/// A servo's RAM settings besides goals, in its byte layout. A power loss loses them.
struct ServoRam {
  explicit ServoRam(const ServoProfile& profile) {
    dxl::put_u16(gains, profile.position_d_gain);
    dxl::put_u16(gains + 2, profile.position_i_gain);
    dxl::put_u16(gains + 4, profile.position_p_gain);
    dxl::put_u16(motion + 4, profile.profile_ms);
  }
  std::uint8_t gains[6];        ///< Position D Gain (80) on
  std::uint8_t motion[8] = {};  ///< Profile Acceleration (108) 0, Velocity in ms
};

/// Max and Min Position Limit (48, 52), EEPROM: the servo enforces them even if the controller
/// fails. One count beyond the joint's limits, so that rounding refuses no goal; within the single
/// turn of position control.
struct ServoLimits {
  explicit ServoLimits(const JointParams& joint) {
    const std::int32_t a = model::count_of(joint, joint.lower_rad);
    const std::int32_t b = model::count_of(joint, joint.upper_rad);
    dxl::put_u32(bytes, in_turn(a > b ? a : b, 1));
    dxl::put_u32(bytes + 4, in_turn(a < b ? a : b, -1));
  }
  std::uint8_t bytes[8];

 private:
  static std::uint32_t in_turn(std::int32_t count, std::int32_t beyond) {
    constexpr std::int32_t kLast = 4095;
    if (count <= 0) return count + beyond > 0 ? static_cast<std::uint32_t>(count + beyond) : 0;
    return static_cast<std::uint32_t>(count < kLast ? count + beyond : kLast);
  }
};

inline const ServoProfile& profile_of(const Params& params, int joint) {
  return params.servo[params.joint[joint].servo_profile % kServoProfiles];
}

}  // namespace verp::app
