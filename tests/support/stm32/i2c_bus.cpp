#include "tests/support/stm32/i2c_bus.hpp"

namespace verp::hal::stm32::model {

void I2cBus::wire(GpioModel& port, unsigned scl, unsigned sda) {
  port_ = &port;
  scl_ = scl;
  sda_ = sda;
  port.drive(scl, GpioModel::Outside::kHigh);
  port.drive(sda, GpioModel::Outside::kHigh);
  port.on_change([this](unsigned pin, bool level) {
    const bool pulse = pin == scl_ && level && port_->mode(scl_) == gpio::kModeOutput;
    if (!pulse || pulses_ == 0) return;
    if (--pulses_ == 0) port_->drive(sda_, GpioModel::Outside::kHigh);
  });
}

void I2cBus::hold_data(unsigned pulses) {
  pulses_ = pulses;
  if (port_ != nullptr) {
    port_->drive(sda_, pulses > 0 ? GpioModel::Outside::kLow : GpioModel::Outside::kHigh);
  }
}

void I2cBus::hold_clock(bool held) {
  clock_held_ = held;
  if (port_ != nullptr) {
    port_->drive(scl_, held ? GpioModel::Outside::kLow : GpioModel::Outside::kHigh);
  }
}

I2cDevice* I2cBus::find(std::uint8_t address, bool read, Time now) {
  for (I2cDevice* device : devices_) {
    if (device->begin(address, read, now)) return device;
  }
  return nullptr;
}

}  // namespace verp::hal::stm32::model
