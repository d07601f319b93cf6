#pragma once
#include <cstdint>
#include <vector>

#include "tests/support/stm32/gpio_model.hpp"

/// The two wires of an I2C bus, and what hangs on them.
namespace verp::hal::stm32::model {

class I2cDevice {
 public:
  virtual ~I2cDevice() = default;
  /// A start (or repeated start) with this 7-bit address; true to acknowledge.
  virtual bool begin(std::uint8_t address, bool read, Time now) = 0;
  virtual bool take(std::uint8_t byte, Time now) = 0;  ///< true to acknowledge
  virtual std::uint8_t give(Time now) = 0;
  virtual void end(Time now) = 0;
};

class I2cBus {
 public:
  void attach(I2cDevice& device) { devices_.push_back(&device); }
  /// The pins of the bus, pulled up from outside. While one is a GPIO output, its edges count.
  void wire(GpioModel& port, unsigned scl, unsigned sda);
  /// A device that lost count holds SDA low until it has seen so many clock pulses.
  void hold_data(unsigned pulses);
  /// A device holds SCL low, for ever or until false.
  void hold_clock(bool held);
  bool data_held() const { return pulses_ > 0; }
  bool clock_held() const { return clock_held_; }
  /// Answers the address, or null.
  I2cDevice* find(std::uint8_t address, bool read, Time now);

 private:
  std::vector<I2cDevice*> devices_;
  GpioModel* port_ = nullptr;
  unsigned scl_ = 0, sda_ = 0;
  unsigned pulses_ = 0;
  bool clock_held_ = false;
};

}  // namespace verp::hal::stm32::model
