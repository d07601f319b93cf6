#include "host/twin/bus/feetech_registers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/io/io.hpp"
#include "common/protocol/feetech.hpp"
#include "common/protocol/feetech_table.hpp"

namespace verp::bus::feetech_bus {
namespace {

namespace mem = feetech::address;
namespace sense = feetech::sensor_block;
using dxl::controller::Access;
using dxl::controller::Type;

constexpr double kTableV = 7.4;  // of the limits below

struct Row {
  NamedRegister reg;
  std::uint16_t initial = 0;
};
constexpr Row seen(std::uint8_t address, const char* name, Type type, const char* unit = "",
                   std::uint16_t initial = 0) {
  return {{.address = address, .name = name, .type = type, .unit = unit}, initial};
}
constexpr Row used(std::uint8_t address, const char* name, Type type, std::uint16_t initial,
                   std::int32_t low, std::uint32_t high, const char* unit = "") {
  return {{address, name, type, Access::kWrite, 1, low, high, unit, ""}, initial};
}

// Initial values and ranges: source [1] of feetech_table.hpp, a servo for 7.4 V.
constexpr auto kServo = std::to_array<Row>({
    seen(mem::kFirmwareMajor, "firmware_major", Type::kU8, "", 3),
    seen(mem::kFirmwareMinor, "firmware_minor", Type::kU8, "", 6),
    seen(mem::kModelNumber, "model_number", Type::kU16, "", feetech::kModelSts3215),
    used(mem::kId, "id", Type::kU8, 1, 0, feetech::kMaxId),
    used(mem::kBaudRate, "baud_rate", Type::kU8, 0, 0, 7),
    used(mem::kReturnDelay, "return_delay", Type::kU8, 0, 0, 254, "2 us"),
    used(mem::kStatusLevel, "status_level", Type::kU8, 1, 0, 1),
    used(mem::kMinPosition, "min_position", Type::kU16, 0, 0, 4094, "counts"),
    used(mem::kMaxPosition, "max_position", Type::kU16, 4095, 0, 4095, "counts"),
    used(mem::kMaxTemperature, "max_temperature", Type::kU8, 70, 0, 100, "deg C"),
    used(mem::kMaxVoltage, "max_voltage", Type::kU8, 80, 0, 254, "0.1 V"),
    used(mem::kMinVoltage, "min_voltage", Type::kU8, 40, 0, 254, "0.1 V"),
    used(mem::kMaxTorque, "max_torque", Type::kU16, 1000, 0, 1000, "0.1 %"),
    used(mem::kPhase, "phase", Type::kU8, 12, 0, 254, "bits"),
    used(mem::kUnloading, "unloading_condition", Type::kU8, 44, 0, 254, "bits"),
    used(mem::kAlarmLed, "alarm_led", Type::kU8, 47, 0, 254, "bits"),
    used(mem::kPGain, "p_gain", Type::kU8, 32, 0, 254),
    used(mem::kDGain, "d_gain", Type::kU8, 32, 0, 254),
    used(mem::kIGain, "i_gain", Type::kU8, 0, 0, 254),
    used(mem::kLeastForce, "least_force", Type::kU16, 16, 0, 1000, "0.1 %"),
    used(mem::kDeadZoneCw, "dead_zone_cw", Type::kU8, 1, 0, 32, "counts"),
    used(mem::kDeadZoneCcw, "dead_zone_ccw", Type::kU8, 1, 0, 32, "counts"),
    used(mem::kProtectionCurrent, "protection_current", Type::kU16, 500, 0, 511, "6.5 mA"),
    used(mem::kResolution, "resolution", Type::kU8, 1, 1, 100),
    used(mem::kOffset, "offset", Type::kI16, 0, -feetech::kMostOffset, feetech::kMostOffset,
         "counts"),
    used(mem::kMode, "mode", Type::kU8, 0, 0, 3),
    used(mem::kProtectiveTorque, "protective_torque", Type::kU8, 20, 0, 254, "%"),
    used(mem::kProtectionTime, "protection_time", Type::kU8, 200, 0, 254, "10 ms"),
    used(mem::kOverloadTorque, "overload_torque", Type::kU8, 80, 0, 254, "%"),
    used(mem::kSpeedP, "speed_p_gain", Type::kU8, 10, 0, 254),
    used(mem::kOverCurrentTime, "over_current_time", Type::kU8, 200, 0, 254, "10 ms"),
    used(mem::kSpeedI, "speed_i_gain", Type::kU8, 10, 0, 254),
    used(mem::kTorqueEnable, "torque_enable", Type::kU8, 0, 0, 255),
    used(mem::kAcceleration, "acceleration", Type::kU8, 0, 0, 254, "100 counts/s^2"),
    used(mem::kGoalPosition, "goal_position", Type::kI16, 0, -32766, 32766, "counts"),
    used(mem::kGoalTime, "goal_time", Type::kU16, 0, 0, 1000),
    used(mem::kGoalSpeed, "goal_speed", Type::kI16, 0, -32767, 32767, "counts/s"),
    used(mem::kTorqueLimit, "torque_limit", Type::kU16, 1000, 0, 1000, "0.1 %"),
    used(mem::kLock, "lock", Type::kU8, 0, 0, 1),
    seen(mem::kPresentPosition, "present_position", Type::kI16, "counts"),
    seen(mem::kPresentSpeed, "present_speed", Type::kI16, "counts/s"),
    seen(mem::kPresentLoad, "present_load", Type::kI16, "0.1 %"),
    seen(mem::kPresentVoltage, "present_voltage", Type::kU8, "0.1 V", 74),
    seen(mem::kPresentTemperature, "present_temperature", Type::kU8, "deg C", 25),
    seen(mem::kRegistered, "registered_instruction", Type::kU8),
    seen(mem::kStatus, "status", Type::kU8, "bits"),
    seen(mem::kMoving, "moving", Type::kU8),
    seen(mem::kPresentCurrent, "present_current", Type::kI16, "6.5 mA"),
});

constexpr auto kSensor = std::to_array<Row>({
    seen(mem::kFirmwareMajor, "firmware_major", Type::kU8, "", 1),
    seen(mem::kFirmwareMinor, "firmware_minor", Type::kU8),
    seen(mem::kModelNumber, "model_number", Type::kU16),
    used(mem::kId, "id", Type::kU8, 1, 0, feetech::kMaxId),
    used(mem::kBaudRate, "baud_rate", Type::kU8, 0, 0, 4),
    used(mem::kReturnDelay, "return_delay", Type::kU8, 0, 0, 254, "2 us"),
    used(mem::kStatusLevel, "status_level", Type::kU8, 1, 0, 1),
});

constexpr NamedRegister row(std::uint8_t address, const char* name, Type type,
                            std::uint16_t count) {
  return {.address = address, .name = name, .type = type, .count = count, .unit = "counts"};
}

template <std::size_t n>
std::vector<NamedRegister> names(const std::array<Row, n>& rows,
                                 std::initializer_list<NamedRegister> more = {}) {
  std::vector<NamedRegister> all;
  for (const Row& each : rows) all.push_back(each.reg);
  all.insert(all.end(), more);
  return all;
}

template <std::size_t n>
std::vector<Register> registers(const std::array<Row, n>& rows, const Identity& identity) {
  std::vector<Register> all;
  for (const auto& [reg, initial] : rows) {
    // A magnitude with a sign is any 16 bits here; the servo clamps its goals.
    const bool magnitude = reg.type == Type::kI16;
    all.push_back({reg.address, dxl::controller::type_bytes(reg.type), reg.writable(), initial,
                   magnitude ? 0 : reg.minimum, magnitude ? 0xFFFF : std::int64_t{reg.maximum}});
  }
  const auto set = [&](std::uint16_t address, std::int64_t value) {
    std::ranges::find(all, address, &Register::address)->initial = value;
  };
  set(mem::kModelNumber, identity.model);
  set(mem::kId, identity.id);
  set(mem::kBaudRate, feetech::baud_rate_code(identity.baud));
  return all;
}

}  // namespace

std::span<const NamedRegister> servo_names() {
  static const std::vector<NamedRegister> kNames = names(kServo);
  return kNames;
}
std::span<const NamedRegister> imu_names() {
  static const std::vector<NamedRegister> kNames =
      names(kSensor, {row(sense::kAddress, "gyro", Type::kI16, 3),
                      row(sense::kAddress + 6, "accel", Type::kI16, 3)});
  return kNames;
}
std::span<const NamedRegister> foot_names() {
  static const std::vector<NamedRegister> kNames =
      names(kSensor, {row(sense::kAddress, "force", Type::kU16, kFootSensors)});
  return kNames;
}

std::vector<Register> servo_registers(const Identity& identity) {
  std::vector<Register> all = registers(kServo, identity);
  // Servos for another supply have other limits; they scale.
  const double share = identity.rating.nominal_v / kTableV;
  for (Register& each : all) {
    if (each.address != mem::kMaxVoltage && each.address != mem::kMinVoltage &&
        each.address != mem::kPresentVoltage) {
      continue;
    }
    each.initial = std::min(std::llround(static_cast<double>(each.initial) * share), 254LL);
  }
  return all;
}

std::vector<Register> sensor_registers(const Identity& identity) {
  std::vector<Register> all = registers(kSensor, identity);
  for (std::uint16_t i = 0; i < sense::kBytes; i += 2) {
    all.push_back({static_cast<std::uint16_t>(sense::kAddress + i), 2, false});
  }
  return all;
}

}  // namespace verp::bus::feetech_bus
