#pragma once
#include <functional>
#include <memory>
#include <string>

#include "hal/contract/imu.hpp"
#include "host/os/imu/i2c_bus.hpp"
#include "host/os/imu/imu_place.hpp"
#include "host/os/imu/imu_reader.hpp"

namespace verp::imu {

/// An open IMU of this PC.
class ImuPort {
 public:
  /// Waits until the chip measures; `interrupted` ends that early. Throws link::LinkError, one line
  /// with the remedy: no such device, no permission, another chip, nobody there.
  ImuPort(const ImuPlace& place, const std::function<bool()>& interrupted,
          I2cCalls& calls = kernel_i2c_calls());
  ~ImuPort();

  /// See ImuReader::start().
  void start(int priority);
  hal::ImuStatus read(hal::ImuSample& sample) { return reader_->read(sample); }
  std::uint32_t faults() const { return reader_->faults(); }

 private:
  struct Bus;  ///< port, registers and driver
  [[noreturn]] void refuse_silent(const ImuPlace& place, I2cCalls& calls);

  std::unique_ptr<Bus> bus_;
  std::unique_ptr<ImuReader> reader_;  ///< its thread uses bus_
};

}  // namespace verp::imu
