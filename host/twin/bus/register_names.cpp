#include "host/twin/bus/register_names.hpp"

#include <array>
#include <optional>
#include <utility>

#include "common/protocol/control_table.hpp"
#include "common/protocol/feetech_table.hpp"
#include "firmware/app/lockstep_messages.hpp"
#include "host/twin/bus/feetech_registers.hpp"
#include "host/twin/bus/modem_device.hpp"
#include "host/twin/bus/servo_registers.hpp"

namespace verp::bus {
namespace {

namespace at = dxl::address;
using dxl::controller::Access;
using dxl::controller::Type;

constexpr NamedRegister seen(std::uint16_t address, const char* name, Type type,
                             const char* unit = "") {
  return {.address = address, .name = name, .type = type, .unit = unit};
}
constexpr NamedRegister used(std::uint16_t address, const char* name, Type type,
                             const char* unit = "") {
  return {address, name, type, Access::kWrite, 1, 0, 0, unit, ""};
}

constexpr NamedRegister row(std::uint16_t address, const char* name, Type type, std::uint16_t count,
                            const char* unit) {
  return {.address = address, .name = name, .type = type, .count = count, .unit = unit};
}

constexpr auto kImu = std::to_array<NamedRegister>({
    seen(at::kModelNumber, "model_number", Type::kU16),
    seen(at::kFirmwareVersion, "firmware_version", Type::kU8),
    used(at::kId, "id", Type::kU8),
    used(at::kReturnDelay, "return_delay_time", Type::kU8, "2 us"),
    row(dxl::sensor_block::kGyro, "gyro", Type::kI16, 3, "counts"),
    row(dxl::sensor_block::kAccel, "accel", Type::kI16, 3, "counts"),
});

constexpr auto kFoot = std::to_array<NamedRegister>({
    seen(at::kModelNumber, "model_number", Type::kU16),
    seen(at::kFirmwareVersion, "firmware_version", Type::kU8),
    used(at::kId, "id", Type::kU8),
    used(at::kReturnDelay, "return_delay_time", Type::kU8, "2 us"),
    row(dxl::sensor_block::kFoot, "force", Type::kU16, kFootSensors, "counts"),
});

// For people; controllers use firmware/app/lockstep_messages.hpp.
constexpr auto kClock = std::to_array<NamedRegister>({
    used(lockstep::kSetUprightAddress, "set_upright", Type::kU8),
});

constexpr NamedRegister block(std::uint16_t address, const char* name, Access access) {
  return {address, name, Type::kU8, access, modem::kMostData, 0, 0xFF, "", ""};
}
constexpr auto kModem = std::to_array<NamedRegister>({
    seen(at::kModelNumber, "model_number", Type::kU16),
    seen(at::kFirmwareVersion, "firmware_version", Type::kU8),
    used(at::kId, "id", Type::kU8),
    used(at::kReturnDelay, "return_delay_time", Type::kU8, "2 us"),
    seen(modem::kNumber, "number", Type::kU8),
    seen(modem::kMostBytes, "most_bytes", Type::kU8),
    seen(modem::kSaid, "said", Type::kU16),
    seen(modem::kRefused, "refused", Type::kU16),
    seen(modem::kHeard, "heard", Type::kU16),
    seen(modem::kMissed, "missed", Type::kU16),
    used(modem::kTo, "to", Type::kU8),
    used(modem::kSaySize, "say_size", Type::kU8),
    block(modem::kSayData, "say_data", Access::kWrite),
    seen(modem::kWaiting, "waiting", Type::kU8),
    seen(modem::kHeardNumber, "heard_number", Type::kU8),
    seen(modem::kHeardFrom, "heard_from", Type::kU8),
    seen(modem::kHeardSize, "heard_size", Type::kU8),
    block(modem::kHeardData, "heard_data", Access::kRead),
    used(modem::kTake, "take", Type::kU8),
});

struct Model {
  std::uint16_t number;
  const char* name;
  std::span<const NamedRegister> registers;
};
constexpr std::array<Model, 5> kModels = {{
    {dxl::kModelImu, "IMU device", kImu},
    {dxl::kModelFoot, "foot device", kFoot},
    {lockstep::kClockModel, "twin's clock", kClock},
    {modem::kModel, "radio modem", kModem},
    {dxl::controller::kModel, "controller", dxl::controller::kTable},
}};

std::optional<Model> find_feetech(std::uint16_t number) {
  switch (number) {
    case feetech::kModelSts3215:
      return Model{number, "STS3215", feetech_bus::servo_names()};
    case feetech::kModelImu:
      return Model{number, "IMU device", feetech_bus::imu_names()};
    case feetech::kModelFoot:
      return Model{number, "foot device", feetech_bus::foot_names()};
    default:
      return std::nullopt;
  }
}

std::optional<Model> find_model(std::uint16_t number, BusProtocol protocol) {
  if (protocol == BusProtocol::kFeetech) return find_feetech(number);
  for (const Model& model : kModels) {
    if (model.number == number) return model;
  }
  const dxl::ServoModel* servo = dxl::find_servo_model(number);
  if (servo == nullptr) return find_feetech(number);
  return Model{number, servo->name, servo::named_registers(*servo)};
}

}  // namespace

std::string hardware_errors(unsigned bits) {
  constexpr std::pair<unsigned, const char*> kNames[] = {
      {dxl::kInputVoltageError, "input voltage"}, {dxl::kOverheatingError, "overheating"},
      {dxl::kEncoderError, "motor encoder"},      {dxl::kElectricalShockError, "electrical shock"},
      {dxl::kOverloadError, "overload"},
  };
  std::string text;
  for (const auto& [bit, name] : kNames) {
    if ((bits & bit) != 0) text += (text.empty() ? "" : ", ") + std::string(name);
  }
  return text.empty() ? "unknown: " + std::to_string(bits) : text;
}

std::string model_name(std::uint16_t model, BusProtocol protocol) {
  const std::optional<Model> known = find_model(model, protocol);
  return !known ? "model " + std::to_string(model) : known->name;
}

std::span<const NamedRegister> registers_of(std::uint16_t model, BusProtocol protocol) {
  const std::optional<Model> known = find_model(model, protocol);
  return known ? known->registers : std::span<const NamedRegister>{};
}

const NamedRegister* find_register(std::uint16_t model, std::string_view name,
                                   BusProtocol protocol) {
  for (const NamedRegister& each : registers_of(model, protocol)) {
    if (name == each.name) return &each;
  }
  return nullptr;
}

}  // namespace verp::bus
