#include "host/twin/bus/servo_registers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <iterator>

#include "common/protocol/controller_table.hpp"

namespace verp::bus::servo {
namespace {

namespace at = dxl::address;
using dxl::controller::Access;
using dxl::controller::Type;

constexpr std::int32_t kTurn = 1044479;  // range of Homing Offset
constexpr std::uint32_t kGain = 16383;
constexpr std::int32_t kWord = 32767;

using Model = dxl::ServoModel;

/// A number, or the model's.
struct Value {
  template <std::integral Number>
  constexpr Value(Number number) : fixed(number) {}
  constexpr Value(std::uint16_t Model::*member) : of(member) {}
  constexpr std::int64_t in(const Model& model) const { return of ? model.*of : fixed; }

  std::int64_t fixed = 0;
  std::uint16_t Model::*of = nullptr;
};

struct Row {
  NamedRegister reg;
  Value initial = 0, minimum = 0, maximum = 0;
  unsigned needs = 0;

  constexpr Row of(unsigned features) const {
    Row row = *this;
    row.needs = features;
    return row;
  }
};
constexpr Row seen(std::uint16_t address, const char* name, Type type, const char* unit = "",
                   Value initial = 0) {
  return {{.address = address, .name = name, .type = type, .unit = unit}, initial};
}
constexpr Row kept(std::uint16_t address, const char* name, Type type, Value initial, Value low,
                   Value high, const char* unit = "") {
  return {
      {.address = address, .name = name, .type = type, .access = Access::kDisarmed, .unit = unit},
      initial,
      low,
      high};
}
constexpr Row used(std::uint16_t address, const char* name, Type type, Value initial, Value low,
                   Value high, const char* unit = "") {
  Row row = kept(address, name, type, initial, low, high, unit);
  row.reg.access = Access::kWrite;
  return row;
}

// e-Manual names; kept() marks EEPROM. What the models differ in: common/protocol/servo_models.hpp.
constexpr auto kRows = std::to_array<Row>({
    seen(at::kModelNumber, "model_number", Type::kU16, "", &Model::number),
    seen(at::kModelInformation, "model_information", Type::kU32),
    seen(at::kFirmwareVersion, "firmware_version", Type::kU8, "", &Model::firmware),
    kept(at::kId, "id", Type::kU8, dxl::kFactoryId, 0, dxl::kMaxId),
    kept(at::kBaudRate, "baud_rate", Type::kU8, 1, 0, &Model::most_baud_code),
    kept(at::kReturnDelay, "return_delay_time", Type::kU8, 250, 0, 254, "2 us"),
    kept(at::kDriveMode, "drive_mode", Type::kU8, 0, 0, &Model::most_drive_mode),
    kept(at::kOperatingMode, "operating_mode", Type::kU8, dxl::kPositionMode, 0, 16),
    kept(at::kSecondaryId, "secondary_id", Type::kU8, 255, 0, 255),  // off from 253
    kept(at::kProtocolVersion, "protocol_type", Type::kU8, 2, &Model::least_protocol,
         &Model::most_protocol),
    kept(at::kHomingOffset, "homing_offset", Type::kI32, 0, -kTurn, kTurn, "counts"),
    kept(at::kMovingThreshold, "moving_threshold", Type::kU32, &Model::moving_threshold, 0, 1023,
         "0.229 rev/min"),
    kept(at::kTemperatureLimit, "temperature_limit", Type::kU8, &Model::hot_c, 0, 100, "deg C"),
    kept(at::kMaxVoltageLimit, "max_voltage_limit", Type::kU16, &Model::most_dv, &Model::least_dv,
         &Model::most_dv, "0.1 V"),
    kept(at::kMinVoltageLimit, "min_voltage_limit", Type::kU16, &Model::low_dv, &Model::least_dv,
         &Model::most_dv, "0.1 V"),
    kept(at::kPwmLimit, "pwm_limit", Type::kU16, dxl::kFullPwm, 0, dxl::kFullPwm),
    kept(at::kCurrentLimit, "current_limit", Type::kU16, &Model::current_limit, 0,
         &Model::current_limit)
        .of(dxl::kCurrentControl),
    kept(at::kAccelerationLimit, "acceleration_limit", Type::kU32, 32767, 0, 32767)
        .of(dxl::kAccelerationBound),
    kept(at::kVelocityLimit, "velocity_limit", Type::kU32, &Model::velocity_limit, 0,
         &Model::most_velocity, "0.229 rev/min"),
    kept(at::kMaxPositionLimit, "max_position_limit", Type::kU32, 4095, 0, 4095, "counts"),
    kept(at::kMinPositionLimit, "min_position_limit", Type::kU32, 0, 0, 4095, "counts"),
    kept(at::kExternalPortMode1, "external_port_mode_1", Type::kU8, 3, 0, 3)
        .of(dxl::kExternalPorts),
    kept(at::kExternalPortMode1 + 1, "external_port_mode_2", Type::kU8, 3, 0, 3)
        .of(dxl::kExternalPorts),
    kept(at::kExternalPortMode1 + 2, "external_port_mode_3", Type::kU8, 3, 0, 3)
        .of(dxl::kExternalPorts),
    kept(at::kStartupConfiguration, "startup_configuration", Type::kU8, 0, 0, 3, "bits")
        .of(dxl::kStartup),
    kept(at::kPwmSlope, "pwm_slope", Type::kU8, &Model::pwm_slope, 1, 255).of(dxl::kPwmSlope),
    kept(at::kShutdown, "shutdown", Type::kU8, &Model::shutdown, 0, 255, "bits"),
    used(at::kTorqueEnable, "torque_enable", Type::kU8, 0, 0, 1),
    used(at::kLed, "led", Type::kU8, 0, 0, 1),
    used(at::kStatusReturnLevel, "status_return_level", Type::kU8, 2, 0, 2),
    seen(at::kRegisteredInstruction, "registered_instruction", Type::kU8),
    seen(at::kHardwareError, "hardware_error_status", Type::kU8, "bits"),
    used(at::kVelocityIGain, "velocity_i_gain", Type::kU16, &Model::velocity_i_gain, 0, kGain),
    used(at::kVelocityPGain, "velocity_p_gain", Type::kU16, &Model::velocity_p_gain, 0, kGain),
    used(at::kPositionDGain, "position_d_gain", Type::kU16, &Model::position_d_gain, 0, kGain),
    used(at::kPositionIGain, "position_i_gain", Type::kU16, &Model::position_i_gain, 0, kGain),
    used(at::kPositionPGain, "position_p_gain", Type::kU16, &Model::position_p_gain, 0, kGain),
    used(at::kFeedforward2Gain, "feedforward_2nd_gain", Type::kU16, 0, 0, kGain),
    used(at::kFeedforward1Gain, "feedforward_1st_gain", Type::kU16, 0, 0, kGain),
    used(at::kBusWatchdog, "bus_watchdog", Type::kU8, 0, 0, dxl::kBusWatchdogMost, "20 ms"),
    // The limits (36, 38, 44) bound the goals.
    used(at::kGoalPwm, "goal_pwm", Type::kI16, dxl::kFullPwm, -kWord, kWord),
    used(at::kGoalCurrent, "goal_current", Type::kI16, &Model::current_limit, -kWord, kWord)
        .of(dxl::kCurrentControl),
    used(at::kGoalVelocity, "goal_velocity", Type::kI32, 0, -kWord, kWord, "0.229 rev/min"),
    used(at::kProfileAcceleration, "profile_acceleration", Type::kU32, 0, 0, 32767),
    used(at::kProfileVelocity, "profile_velocity", Type::kU32, 0, 0, 32767),
    used(at::kGoalPosition, "goal_position", Type::kI32, 0, -kMostTurns, kMostTurns, "counts"),
    seen(at::kRealtimeTick, "realtime_tick", Type::kU16, "ms"),
    seen(at::kMoving, "moving", Type::kU8),
    seen(at::kMovingStatus, "moving_status", Type::kU8, "bits"),
    seen(at::kPresentPwm, "present_pwm", Type::kI16),
    seen(at::kPresentCurrent, "present_current", Type::kI16).of(dxl::kCurrentControl),
    seen(at::kPresentCurrent, "present_load", Type::kI16, "0.1 %").of(dxl::kLoad),
    seen(at::kPresentVelocity, "present_velocity", Type::kI32, "0.229 rev/min"),
    seen(at::kPresentPosition, "present_position", Type::kI32, "counts"),
    seen(at::kVelocityTrajectory, "velocity_trajectory", Type::kI32, "0.229 rev/min"),
    seen(at::kPositionTrajectory, "position_trajectory", Type::kI32, "counts"),
    seen(at::kPresentVoltage, "present_input_voltage", Type::kU16, "0.1 V", 120),
    seen(at::kPresentTemperature, "present_temperature", Type::kU8, "deg C", 25),
    seen(at::kBackupReady, "backup_ready", Type::kU8).of(dxl::kStartup),
    used(at::kExternalPortData1, "external_port_data_1", Type::kU16, 0, 0, 0xFFFF)
        .of(dxl::kExternalPorts),
    used(at::kExternalPortData1 + 2, "external_port_data_2", Type::kU16, 0, 0, 0xFFFF)
        .of(dxl::kExternalPorts),
    used(at::kExternalPortData1 + 4, "external_port_data_3", Type::kU16, 0, 0, 0xFFFF)
        .of(dxl::kExternalPorts),
});

std::vector<NamedRegister> names_of(const Model& model) {
  std::vector<NamedRegister> names;
  for (const Row& row : kRows) {
    if (!model.has(row.needs)) continue;
    NamedRegister& reg = names.emplace_back(row.reg);
    reg.minimum = static_cast<std::int32_t>(row.minimum.in(model));
    reg.maximum = static_cast<std::uint32_t>(row.maximum.in(model));
    if (row.needs == dxl::kCurrentControl) reg.unit = model.current_unit;
  }
  return names;
}

void append_indirect(const Model& model, std::vector<Register>& registers) {
  for (const auto& [addresses, data, pairs] : model.indirect) {
    for (std::uint16_t n = 0; n < pairs; ++n) {
      registers.push_back({static_cast<std::uint16_t>(addresses + 2 * n), 2, true, data + n,
                           dxl::kIndirectFirst, model.last_indirect()});
    }
    for (std::uint16_t n = 0; n < pairs; ++n) {
      registers.push_back({static_cast<std::uint16_t>(data + n), 1, true, 0, 0, 255});
    }
  }
}

}  // namespace

const dxl::ServoModel& model_of(std::uint16_t number) {
  const Model* known = dxl::find_servo_model(number);
  if (known != nullptr) return *known;
  return *dxl::find_servo_model(number < 1000 ? dxl::kModelMx28 : dxl::kModelXm430W210);
}

std::span<const NamedRegister> named_registers(const dxl::ServoModel& model) {
  static const auto kNames = [] {
    std::array<std::vector<NamedRegister>, std::size(dxl::kServoModels)> names;
    std::ranges::transform(dxl::kServoModels, names.begin(), names_of);
    return names;
  }();
  return kNames[static_cast<std::size_t>(&model - dxl::kServoModels)];
}

std::vector<Register> registers_of(const ServoIdentity& identity) {
  const Model& model = model_of(identity.model);
  std::vector<Register> registers;
  for (const Row& row : kRows) {
    if (!model.has(row.needs)) continue;
    const NamedRegister& reg = row.reg;
    const bool shows_sign = dxl::controller::is_signed(reg.type) && !reg.writable();
    registers.push_back({reg.address, dxl::controller::type_bytes(reg.type), reg.writable(),
                         row.initial.in(model), shows_sign ? -1 : row.minimum.in(model),
                         row.maximum.in(model)});
  }
  const auto find = [&](std::uint16_t address) {
    return std::ranges::find(registers, address, &Register::address);
  };
  find(at::kModelNumber)->initial = identity.model;
  find(at::kId)->initial = identity.id;
  find(at::kBaudRate)->initial = dxl::baud_rate_code(identity.baud);
  // A robot's own type may have a supply that the model lacks; its limits scale.
  const double supply_dv = 10 * identity.rating.nominal_v;
  if (supply_dv < model.least_dv || supply_dv > model.most_dv) {
    for (const std::uint16_t limit : {at::kMaxVoltageLimit, at::kMinVoltageLimit}) {
      Register& reg = *find(limit);
      for (std::int64_t* value : {&reg.initial, &reg.minimum, &reg.maximum}) {
        *value = std::llround(static_cast<double>(*value) * supply_dv / model.nominal_dv);
      }
    }
  }
  find(at::kPresentVoltage)->initial = std::llround(supply_dv);
  append_indirect(model, registers);
  return registers;
}

}  // namespace verp::bus::servo
