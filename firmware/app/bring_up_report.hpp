#pragma once
#include <cstdint>

#include "common/io/io.hpp"

namespace verp::app {

enum class BringUpStatus : std::uint8_t {
  kReady,
  kSilent,
  kWrongModel,
  kRefused,
  kNotVerified,
  kHardwareError,  ///< it may have shut its torque off, and stays limp until it is rebooted
  kOccupied,       ///< somebody else commands nodes on this bus; nothing was sent
  kNotReset,       ///< it answers, and sent no boot-up message when it was reset
};

/// The first device that stopped the bring-up, and where; and what was found.
struct BringUpReport {
  BringUpStatus status = BringUpStatus::kReady;
  std::uint8_t device_id = 0;
  std::uint16_t address = 0;   ///< register, or index of the object, at which it failed;
                               ///< the identifier that was heard, for kOccupied
  std::uint16_t expected = 0;  ///< model numbers, for kWrongModel
  std::uint16_t found = 0;     ///< and bits of dxl::HardwareError, for kHardwareError
  /// What is all of each joint's strength: PWM Limit of a servo, max torque (6072h) of a drive. Its
  /// owner may have set less than it can.
  std::uint16_t full_strength[kMaxJoints] = {};
  /// Bit j: joint j's drive has a vendor id (1018h:1) that is not ours.
  std::uint32_t foreign_drives = 0;
};

}  // namespace verp::app
