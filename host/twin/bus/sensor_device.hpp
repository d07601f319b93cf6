#pragma once
#include <cstdint>

#include "host/twin/bus/device.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::bus {

/// A sensor on the servo bus with the twelve-byte sensor block (common/protocol/control_table.hpp).
class SensorDevice : public Device {
 protected:
  SensorDevice(std::uint8_t id, std::uint16_t model, std::uint32_t baud, sim::Plant& plant);
  void written(std::uint16_t, std::uint16_t) override {}
  void put(int word, std::uint16_t value);
  sim::Plant& plant_;
};

class ImuDevice final : public SensorDevice {
 public:
  ImuDevice(std::uint8_t id, std::uint32_t baud, sim::Plant& plant)
      : SensorDevice(id, dxl::kModelImu, baud, plant) {}
  void refresh(std::uint16_t address, std::uint16_t length) override;
};

class FootDevice final : public SensorDevice {
 public:
  FootDevice(std::uint8_t id, std::uint32_t baud, sim::Plant& plant, int foot)
      : SensorDevice(id, dxl::kModelFoot, baud, plant), foot_(foot) {}
  void refresh(std::uint16_t address, std::uint16_t length) override;

 private:
  int foot_;
};

}  // namespace verp::bus
