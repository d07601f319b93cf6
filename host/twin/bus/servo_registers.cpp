#include "host/twin/bus/servo_registers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/protocol/controller_table.hpp"

namespace verp::bus::servo {
namespace {

namespace at = dxl::address;
using dxl::controller::Access;
using dxl::controller::Type;

constexpr std::int32_t kTurn = 1044479;  // range of Homing Offset
constexpr std::uint32_t kGain = 16383;

struct Row {
  NamedRegister reg;
  std::int64_t initial = 0;
};
constexpr Row seen(std::uint16_t address, const char* name, Type type, const char* unit = "",
                   std::int64_t initial = 0) {
  return {{.address = address, .name = name, .type = type, .unit = unit}, initial};
}
constexpr Row kept(std::uint16_t address, const char* name, Type type, std::int64_t initial,
                   std::int32_t low, std::uint32_t high, const char* unit = "") {
  return {{address, name, type, Access::kDisarmed, 1, low, high, unit, ""}, initial};
}
constexpr Row used(std::uint16_t address, const char* name, Type type, std::int64_t initial,
                   std::int32_t low, std::uint32_t high, const char* unit = "") {
  return {{address, name, type, Access::kWrite, 1, low, high, unit, ""}, initial};
}

// e-Manual names; kept() marks EEPROM. Values and ranges: e-Manual, XM430-W210. Only the X-series
// has current registers; only the MX series has Acceleration Limit.
constexpr auto kRows = std::to_array<Row>({
    seen(at::kModelNumber, "model_number", Type::kU16),
    seen(at::kModelInformation, "model_information", Type::kU32),
    seen(at::kFirmwareVersion, "firmware_version", Type::kU8, "", 45),  // first with Fast Sync Read
    kept(at::kId, "id", Type::kU8, 0, 0, dxl::kMaxId),
    kept(at::kBaudRate, "baud_rate", Type::kU8, 0, 0, 7),
    kept(at::kReturnDelay, "return_delay_time", Type::kU8, 250, 0, 254, "2 us"),
    kept(at::kDriveMode, "drive_mode", Type::kU8, 0, 0, 13),
    kept(at::kOperatingMode, "operating_mode", Type::kU8, dxl::kPositionMode, 0, 16),
    kept(at::kSecondaryId, "secondary_id", Type::kU8, 255, 0, 255),
    kept(at::kProtocolVersion, "protocol_type", Type::kU8, 2, 1, 2),
    kept(at::kHomingOffset, "homing_offset", Type::kI32, 0, -kTurn, kTurn, "counts"),
    kept(at::kMovingThreshold, "moving_threshold", Type::kU32, 10, 0, 1023, "0.229 rev/min"),
    kept(at::kTemperatureLimit, "temperature_limit", Type::kU8, 80, 0, 100, "deg C"),
    kept(at::kMaxVoltageLimit, "max_voltage_limit", Type::kU16, 160, 95, 160, "0.1 V"),
    kept(at::kMinVoltageLimit, "min_voltage_limit", Type::kU16, 95, 95, 160, "0.1 V"),
    kept(at::kPwmLimit, "pwm_limit", Type::kU16, dxl::kFullPwm, 0, dxl::kFullPwm),
    kept(at::kCurrentLimit, "current_limit", Type::kU16, 1193, 0, 1193),
    kept(at::kAccelerationLimit, "acceleration_limit", Type::kU32, 32767, 0, 32767),
    kept(at::kVelocityLimit, "velocity_limit", Type::kU32, 330, 0, 1023, "0.229 rev/min"),
    kept(at::kMaxPositionLimit, "max_position_limit", Type::kU32, 4095, 0, 4095, "counts"),
    kept(at::kMinPositionLimit, "min_position_limit", Type::kU32, 0, 0, 4095, "counts"),
    kept(at::kShutdown, "shutdown", Type::kU8, 52, 0, 255, "bits"),
    used(at::kTorqueEnable, "torque_enable", Type::kU8, 0, 0, 1),
    used(at::kLed, "led", Type::kU8, 0, 0, 1),
    used(at::kStatusReturnLevel, "status_return_level", Type::kU8, 2, 0, 2),
    seen(at::kRegisteredInstruction, "registered_instruction", Type::kU8),
    seen(at::kHardwareError, "hardware_error_status", Type::kU8, "bits"),
    used(at::kVelocityIGain, "velocity_i_gain", Type::kU16, 1920, 0, kGain),
    used(at::kVelocityPGain, "velocity_p_gain", Type::kU16, 100, 0, kGain),
    used(at::kPositionDGain, "position_d_gain", Type::kU16, 0, 0, kGain),
    used(at::kPositionIGain, "position_i_gain", Type::kU16, 0, 0, kGain),
    used(at::kPositionPGain, "position_p_gain", Type::kU16, 800, 0, kGain),
    used(at::kFeedforward2Gain, "feedforward_2nd_gain", Type::kU16, 0, 0, kGain),
    used(at::kFeedforward1Gain, "feedforward_1st_gain", Type::kU16, 0, 0, kGain),
    used(at::kBusWatchdog, "bus_watchdog", Type::kU8, 0, 0, dxl::kBusWatchdogMost, "20 ms"),
    used(at::kGoalPwm, "goal_pwm", Type::kI16, dxl::kFullPwm, -dxl::kFullPwm, dxl::kFullPwm),
    used(at::kGoalCurrent, "goal_current", Type::kI16, 1193, -1193, 1193),
    used(at::kGoalVelocity, "goal_velocity", Type::kI32, 0, -1023, 1023, "0.229 rev/min"),
    used(at::kProfileAcceleration, "profile_acceleration", Type::kU32, 0, 0, 32767),
    used(at::kProfileVelocity, "profile_velocity", Type::kU32, 0, 0, 32767),
    used(at::kGoalPosition, "goal_position", Type::kI32, 0, -kMostTurns, kMostTurns, "counts"),
    seen(at::kRealtimeTick, "realtime_tick", Type::kU16, "ms"),
    seen(at::kMoving, "moving", Type::kU8),
    seen(at::kMovingStatus, "moving_status", Type::kU8, "bits"),
    seen(at::kPresentPwm, "present_pwm", Type::kI16),
    seen(at::kPresentCurrent, "present_current", Type::kI16),
    seen(at::kPresentVelocity, "present_velocity", Type::kI32, "0.229 rev/min"),
    seen(at::kPresentPosition, "present_position", Type::kI32, "counts"),
    seen(at::kVelocityTrajectory, "velocity_trajectory", Type::kI32, "0.229 rev/min"),
    seen(at::kPositionTrajectory, "position_trajectory", Type::kI32, "counts"),
    seen(at::kPresentVoltage, "present_input_voltage", Type::kU16, "0.1 V", 120),
    seen(at::kPresentTemperature, "present_temperature", Type::kU8, "deg C", 25),
    seen(at::kBackupReady, "backup_ready", Type::kU8),
});

constexpr auto kNames = [] {
  std::array<NamedRegister, kRows.size()> names{};
  std::ranges::transform(kRows, names.begin(), &Row::reg);
  return names;
}();

}  // namespace

std::span<const NamedRegister> named_registers() {
  return kNames;
}

std::vector<Register> registers_of(const ServoIdentity& identity) {
  const bool mx = identity.model < 1000;
  std::vector<Register> registers;
  for (const auto& [reg, initial] : kRows) {
    const bool is_signed = dxl::controller::is_signed(reg.type);
    registers.push_back({reg.address, dxl::controller::type_bytes(reg.type), reg.writable(),
                         initial, is_signed && !reg.writable() ? -1 : reg.minimum, reg.maximum});
  }
  const auto find = [&](std::uint16_t address) {
    return std::ranges::find(registers, address, &Register::address);
  };
  find(at::kModelNumber)->initial = identity.model;
  find(at::kId)->initial = identity.id;
  find(at::kBaudRate)->initial = dxl::baud_rate_code(identity.baud);
  const auto tenths = [](double volts) { return std::llround(10 * volts); };
  for (const std::uint16_t limit : {at::kMaxVoltageLimit, at::kMinVoltageLimit}) {
    find(limit)->minimum = tenths(identity.rating.least_v());
    find(limit)->maximum = tenths(identity.rating.most_v());
  }
  find(at::kMaxVoltageLimit)->initial = find(at::kMaxVoltageLimit)->maximum;
  find(at::kMinVoltageLimit)->initial = find(at::kMinVoltageLimit)->minimum;
  find(at::kPresentVoltage)->initial = tenths(identity.rating.nominal_v);
  if (mx) {
    find(at::kDriveMode)->maximum = 5;
    find(at::kVelocityLimit)->initial = 380;
    find(at::kPositionPGain)->initial = 850;
  }
  registers.insert(find(at::kShutdown), {kStartupConfiguration, 1, true, 0, 0, 3});
  for (const auto& [addresses, data] : {std::pair{at::kIndirectAddress1, at::kIndirectData1},
                                        std::pair{at::kIndirectAddress29, at::kIndirectData29}}) {
    for (std::uint16_t n = 0; n < dxl::kIndirectBlock; ++n) {
      registers.push_back({static_cast<std::uint16_t>(addresses + 2 * n), 2, true, data + n,
                           dxl::kIndirectFirst, dxl::kIndirectLast});
    }
    for (std::uint16_t n = 0; n < dxl::kIndirectBlock; ++n) {
      registers.push_back({static_cast<std::uint16_t>(data + n), 1, true, 0, 0, 255});
    }
  }
  std::erase_if(registers, [mx](const Register& reg) {
    if (mx) {
      return reg.address == at::kCurrentLimit || reg.address == at::kGoalCurrent ||
             reg.address == kStartupConfiguration;
    }
    return reg.address == at::kAccelerationLimit;
  });
  return registers;
}

}  // namespace verp::bus::servo
