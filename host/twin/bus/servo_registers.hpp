#pragma once
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "common/protocol/servo_models.hpp"
#include "host/twin/bus/register_names.hpp"
#include "host/twin/bus/register_table.hpp"
#include "host/twin/bus/servo_device.hpp"

/// A servo's control table, by its model (common/protocol/servo_models.hpp).
namespace verp::bus::servo {

inline constexpr double kVelocityUnitRadS = 0.229 * 2.0 * std::numbers::pi / 60.0;
constexpr double current_unit_a(const dxl::ServoModel& model) {
  return model.current_unit_10ua / 1e5;
}
inline constexpr double kLoadFull = 1000;  // Present Load in 0.1 %
inline constexpr std::int64_t kRealtimeTickWrap = 32768;
inline constexpr double kCountsPerTurn = dxl::kCountsPerTurn;
inline constexpr double kVelocityUnitCountS = 0.229 / 60 * kCountsPerTurn;
// Profile Acceleration (108): 214.577 rev/min^2.
inline constexpr double kAccelerationUnitCountS2 = 214.577 / 3600 * kCountsPerTurn;
inline constexpr std::int64_t kMostTurns = 1'048'575;  // Goal Position (116), 256 turns
// Operating Mode (11).
enum OperatingMode : std::uint8_t {
  kCurrentMode,
  kVelocityMode,
  kTurnsMode = 4,
  kCurrentPositionMode,
  kPwmMode = 16
};
// Drive Mode (10).
inline constexpr std::uint8_t kReverse = 1 << 0;
inline constexpr std::uint8_t kTorqueOnByGoal = 1 << 3;
// Startup Configuration (60).
inline constexpr std::uint8_t kStartupTorqueOn = 1 << 0;
inline constexpr std::uint8_t kRamRestore = 1 << 1;
// Control Table Backup (0x20): commands and the guard word.
inline constexpr std::uint8_t kStore = 1, kRestore = 2;
inline constexpr std::uint8_t kBackupWord[] = {'C', 'T', 'R', 'L'};
// Moving Status (123); its bounds are estimates.
inline constexpr std::uint8_t kInPosition = 1 << 0, kOngoing = 1 << 1, kNotFollowing = 1 << 3;
inline constexpr double kInPositionCount = 10;
inline constexpr double kFollowingCount = 57;  // 5 degrees

/// A number without a row: as an MX-28 below 1000, else as an XM430-W210.
const dxl::ServoModel& model_of(std::uint16_t number);
/// Sorted by address, without the indirect ones; `model` is a row of dxl::kServoModels.
std::span<const NamedRegister> named_registers(const dxl::ServoModel& model);
std::vector<Register> registers_of(const ServoIdentity& identity);

}  // namespace verp::bus::servo
