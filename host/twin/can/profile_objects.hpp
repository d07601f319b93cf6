#pragma once
#include <cstdint>
#include <span>

#include "common/protocol/canopen/drive_objects.hpp"

namespace verp::can {

/// Modes of operation (6060h) that a master uses to set up a drive.
inline constexpr std::int8_t kModeProfilePosition = 1;
inline constexpr std::int8_t kModeHoming = 6;
constexpr bool has_mode(std::int8_t mode) {
  return mode == canopen::cia402::kModeNone || mode == kModeProfilePosition ||
         mode == kModeHoming || mode == canopen::cia402::kModeCyclicPosition;
}
/// 6502h: bit n - 1 for mode n.
inline constexpr std::uint32_t kDriveModes = canopen::cia402::kSupportedCyclicPosition |
                                             1u << (kModeProfilePosition - 1) |
                                             1u << (kModeHoming - 1);

namespace profile_at {
using canopen::Address;
inline constexpr Address kPositionWindow{0x6067, 0};
inline constexpr Address kPositionWindowTime{0x6068, 0};
inline constexpr Address kMaxVelocity{0x607F, 0};
inline constexpr Address kVelocity{0x6081, 0};
inline constexpr Address kAcceleration{0x6083, 0};
inline constexpr Address kDeceleration{0x6084, 0};
inline constexpr Address kProfileType{0x6086, 0};
inline constexpr Address kHomingMethod{0x6098, 0};
inline constexpr Address kSwitchSpeed{0x6099, 1};
inline constexpr Address kZeroSpeed{0x6099, 2};
inline constexpr Address kHomingAcceleration{0x609A, 0};
}  // namespace profile_at

/// Objects of modes 1 and 6 that mode 8 does not have; increments and seconds.
struct ProfileObjects {
  std::uint32_t position_window = UINT32_MAX;  ///< UINT32_MAX: reached when the ramp ends
  std::uint32_t max_velocity = UINT32_MAX;
  std::uint32_t velocity = 0;
  std::uint32_t acceleration = 0;
  std::uint32_t deceleration = 0;
  std::uint32_t switch_speed = 0;  ///< kept only: no method here moves
  std::uint32_t zero_speed = 0;
  std::uint32_t homing_acceleration = 0;
  std::uint16_t position_window_time_ms = 0;
  std::int16_t profile_type = 0;  ///< linear ramp (trapezoid)
  std::int8_t homing_method = 0;  ///< none
};

/// Homing methods without a switch: home is where the joint stands.
constexpr bool homes_in_place(std::int8_t method) {
  return method == 35 || method == 37;
}

/// The dictionary's rows; `place` is in ProfileObjects.
std::span<const canopen::cia402::ObjectRow> profile_rows();
/// False: not an object of this table.
bool is_profile_object(std::uint16_t index);
/// Its value depends on the joint.
bool is_commissioned(canopen::Address at);

canopen::Abort find_profile(canopen::Address at, canopen::Entry& entry);
/// The value's bytes; `at` was found.
void read_profile(const ProfileObjects& objects, canopen::Address at, std::uint8_t* buffer);
/// Refuses ramps of another type or without acceleration, and methods that need a switch.
canopen::Abort write_profile(ProfileObjects& objects, canopen::Address at,
                             const std::uint8_t* data);
canopen::Abort profile_mappable(canopen::Address at, std::uint8_t bits);

}  // namespace verp::can
