#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "host/twin/bus/register_names.hpp"
#include "host/twin/bus/register_table.hpp"
#include "host/twin/sim/plant.hpp"

/// Memory tables of the twin's Feetech devices (common/protocol/feetech_table.hpp).
namespace verp::bus::feetech_bus {

struct Identity {
  std::uint8_t id = 1;
  std::uint16_t model = 0;
  std::uint32_t baud = 1000000;
  sim::ServoRating rating{};
};

/// Sorted by address. Registers with a sign bit are kI16; the wire has a magnitude.
std::span<const NamedRegister> servo_names();
std::span<const NamedRegister> imu_names();
std::span<const NamedRegister> foot_names();

/// Raw values, as on the wire.
std::vector<Register> servo_registers(const Identity& identity);
std::vector<Register> sensor_registers(const Identity& identity);

}  // namespace verp::bus::feetech_bus
