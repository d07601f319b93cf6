#include "host/twin/bus/sensor_device.hpp"

namespace verp::bus {
namespace {

namespace at = dxl::address;

std::vector<Register> sensor_registers(std::uint8_t id, std::uint16_t model, std::uint32_t baud) {
  std::vector<Register> registers = {
      {at::kModelNumber, 2, false, model},
      {at::kModelInformation, 4, false, 0},
      {at::kFirmwareVersion, 1, false, 1},
      {at::kId, 1, true, id, 0, dxl::kMaxId},
      {at::kBaudRate, 1, true, dxl::baud_rate_code(baud), 0, 7},
      {at::kReturnDelay, 1, true, 250, 0, 254},
      {at::kLed, 1, true, 0, 0, 1},
  };
  for (std::uint16_t word = 0; word < dxl::sensor_block::kBytes / 2; ++word) {
    const int address = dxl::sensor_block::kAddress + 2 * word;
    registers.push_back({static_cast<std::uint16_t>(address), 2, false, 0});
  }
  return registers;
}

bool reads_block(std::uint16_t address, std::uint16_t length) {
  return address + length > dxl::sensor_block::kAddress;
}

}  // namespace

SensorDevice::SensorDevice(std::uint8_t id, std::uint16_t model, std::uint32_t baud,
                           sim::Plant& plant)
    : Device(sensor_registers(id, model, baud)), plant_(plant) {}

void SensorDevice::put(int word, std::uint16_t value) {
  table_.set(static_cast<std::uint16_t>(dxl::sensor_block::kAddress + 2 * word), value);
}

void ImuDevice::refresh(std::uint16_t address, std::uint16_t length) {
  if (!reads_block(address, length)) return;
  const sim::ImuMeasurement measured = plant_.imu();
  for (unsigned axis = 0; axis < 3; ++axis) {
    put(static_cast<int>(axis), static_cast<std::uint16_t>(measured.gyro_count[axis]));
    put(static_cast<int>(axis) + 3, static_cast<std::uint16_t>(measured.accel_count[axis]));
  }
}

void FootDevice::refresh(std::uint16_t address, std::uint16_t length) {
  if (!reads_block(address, length)) return;
  const std::array<std::uint16_t, 4> counts = plant_.foot_counts(foot_);
  for (unsigned i = 0; i < counts.size(); ++i) put(static_cast<int>(i), counts[i]);
}

}  // namespace verp::bus
