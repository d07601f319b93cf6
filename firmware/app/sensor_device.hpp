#pragma once
#include "firmware/app/dynamixel_device.hpp"
#include "firmware/app/sensor_registers.hpp"

namespace verp::app {

extern template class DynamixelDevice<SensorRegisters>;

/// The robot's IMU, or one of its feet, as a device on its servo bus.
class SensorDevice : public DynamixelDevice<SensorRegisters> {
 public:
  SensorDevice(hal::ByteLink& link, std::uint8_t id, std::uint16_t model, std::uint32_t baud)
      : DynamixelDevice(link, id, model, baud) {}
};

}  // namespace verp::app
