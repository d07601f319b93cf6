#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp::app {

template <class Words>
class RequestMaster;
using BusMaster = RequestMaster<struct DynamixelWords>;
using FeetechMaster = RequestMaster<struct FeetechWords>;
class CanMaster;

enum class BringUpStatus : std::uint8_t {
  kReady,
  kSilent,
  kWrongModel,
  kRefused,
  kNotVerified,
  kHardwareError,  ///< torque may be off; limp until rebooted
  kOccupied,       ///< another controller commands nodes; nothing was sent
  kNotReset,       ///< no boot-up message after the reset
};

/// The first device that stopped the bring-up.
struct BringUpReport {
  BringUpStatus status = BringUpStatus::kReady;
  std::uint8_t device_id = 0;
  std::uint16_t address = 0;   ///< register or object index; kOccupied: identifier heard
  std::uint16_t expected = 0;  ///< for kWrongModel
  std::uint16_t found = 0;     ///< model number; kHardwareError: dxl::HardwareError bits
  /// A servo's PWM Limit or a drive's max torque (6072h), which the owner may have reduced.
  std::uint16_t full_strength[kMaxJoints] = {};
  /// Bit j: joint j's drive has another maker's vendor id (1018h:1).
  std::uint32_t foreign_drives = 0;
};

/// Finds every device of the robot on the bus and writes its settings from Params, torque off.
/// Writes EEPROM only where it differs, because it wears out; reads everything back.
BringUpReport bring_up(const Params& params, BusMaster& master);
BringUpReport bring_up(const Params& params, FeetechMaster& master);

/// Finds every node of the robot, sets it up and starts it, torque off. It listens first: resetting
/// nodes would drop a robot that another controller runs. It then resets all nodes, so none stays
/// stiff and unwritten settings have their stored values.
BringUpReport bring_up(const Params& params, CanMaster& master);

}  // namespace verp::app
