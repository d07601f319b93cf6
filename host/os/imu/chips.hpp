#pragma once
#include <cstdint>
#include <string>

#include "hal/contract/register_bus.hpp"
#include "host/os/imu/imu_place.hpp"

namespace verp::imu {

struct ChipType {
  Chip chip;
  const char* name;
  std::uint8_t id_at, id;     ///< the register that identifies the chip
  std::uint8_t addresses[2];  ///< on I2C, the usual one first
  bool has_uart;
  const char* wiring;  ///< what else to check if it is silent
};

const ChipType& type_of(Chip chip);
const ChipType* find_chip(const std::string& name);
/// "bno055, mpu6050".
std::string chip_names(bool with_uart);

/// The chip whose identity these registers show; null: none of ours.
const ChipType* identify(hal::RegisterBus& bus);

}  // namespace verp::imu
