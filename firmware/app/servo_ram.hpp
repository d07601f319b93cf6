#pragma once
#include <cstdint>

#include "common/model/params.hpp"
#include "common/protocol/dynamixel2.hpp"

namespace verp::app {

/// What a servo's RAM must hold besides goals, byte for byte as it stands there. A servo that lost
/// its power has lost it too.
struct ServoRam {
  explicit ServoRam(const ServoProfile& profile) {
    dxl::put_u16(gains, profile.position_d_gain);
    dxl::put_u16(gains + 2, profile.position_i_gain);
    dxl::put_u16(gains + 4, profile.position_p_gain);
    dxl::put_u16(motion + 4, profile.profile_ms);
  }
  std::uint8_t gains[6];        ///< from Position D Gain (80) on
  std::uint8_t motion[8] = {};  ///< Profile Acceleration (108) 0, Profile Velocity in ms
};

inline const ServoProfile& profile_of(const Params& params, int joint) {
  return params.servo[params.joint[joint].servo_profile % kServoProfiles];
}

}  // namespace verp::app
