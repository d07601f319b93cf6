#pragma once
#include <cstdint>
#include <string>

#include "hal/contract/register_bus.hpp"
#include "host/os/link/port.hpp"

struct i2c_rdwr_ioctl_data;

namespace verp::imu {

/// Like the system calls: negative and errno on failure. Tests replace them: their kernel has no
/// bus.
class I2cCalls {
 public:
  virtual ~I2cCalls() = default;
  virtual int open(const char* device) = 0;
  virtual int transfer(int descriptor, i2c_rdwr_ioctl_data& messages) = 0;
};
I2cCalls& kernel_i2c_calls();

/// One chip on a bus of Linux (`/dev/i2c-1`). A bus that is gone, as a USB adapter's, is opened
/// again.
class I2cBus final : public hal::RegisterBus {
 public:
  /// Throws link::LinkError.
  I2cBus(const std::string& device, std::uint8_t address, I2cCalls& calls = kernel_i2c_calls());

  bool read(std::uint8_t address, std::uint8_t* data, std::size_t size) override;
  bool write(std::uint8_t address, const std::uint8_t* data, std::size_t size) override;

 private:
  bool transfer(i2c_rdwr_ioctl_data& messages);

  I2cCalls& calls_;
  const std::string device_;
  const std::uint8_t chip_;
  link::Descriptor descriptor_;
};

}  // namespace verp::imu
