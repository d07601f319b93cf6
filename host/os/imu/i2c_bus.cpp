#include "host/os/imu/i2c_bus.hpp"

#include <fcntl.h>
#include <linux/i2c-dev.h>
#include <linux/i2c.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "host/os/link/link_error.hpp"

namespace verp::imu {
namespace {

using Kind = link::LinkError::Kind;

class KernelI2cCalls final : public I2cCalls {
 public:
  int open(const char* device) override {
    const int descriptor = ::open(device, O_RDWR | O_CLOEXEC);
    if (descriptor < 0) return descriptor;
    unsigned long functions = 0;
    if (::ioctl(descriptor, I2C_FUNCS, &functions) != 0 || (functions & I2C_FUNC_I2C) == 0) {
      ::close(descriptor);
      errno = ENOTTY;
      return -1;
    }
    ::ioctl(descriptor, I2C_TIMEOUT, 2UL);  // in 10 ms
    ::ioctl(descriptor, I2C_RETRIES, 1UL);
    return descriptor;
  }
  int transfer(int descriptor, i2c_rdwr_ioctl_data& messages) override {
    return ::ioctl(descriptor, I2C_RDWR, &messages);
  }
};

std::string buses_here() {
  std::string names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/dev", error)) {
    const std::string path = entry.path().string();
    if (path.starts_with("/dev/i2c-")) names += (names.empty() ? "" : " ") + path;
  }
  return names.empty()
             ? "switch I2C on: sudo raspi-config nonint do_i2c 0, or sudo modprobe i2c-dev"
             : "here are " + names;
}

link::LinkError open_error(const std::string& device, int error) {
  if (error == EACCES || error == EPERM) {
    return {Kind::kPermission, device +
                                   ": no permission; join the group that may: sudo usermod -aG i2c "
                                   "$USER, then log in again"};
  }
  if (error == ENOTTY) {
    return {Kind::kUnsuitable, device + ": is no I2C bus; " + buses_here()};
  }
  return {Kind::kNoDevice, device + ": " +
                               (error == ENOENT ? "no such device" : std::strerror(error)) + "; " +
                               buses_here()};
}

}  // namespace

I2cCalls& kernel_i2c_calls() {
  static KernelI2cCalls calls;
  return calls;
}

I2cBus::I2cBus(const std::string& device, std::uint8_t address, I2cCalls& calls)
    : calls_(calls), device_(device), chip_(address), descriptor_(calls.open(device.c_str())) {
  if (descriptor_.get() < 0) throw open_error(device, errno);
}

bool I2cBus::read(std::uint8_t address, std::uint8_t* data, std::size_t size) {
  i2c_msg parts[] = {{chip_, 0, 1, &address},
                     {chip_, I2C_M_RD, static_cast<std::uint16_t>(size), data}};
  i2c_rdwr_ioctl_data messages{parts, 2};
  return transfer(messages);
}

bool I2cBus::write(std::uint8_t address, const std::uint8_t* data, std::size_t size) {
  std::uint8_t bytes[1 + hal::kMostRegisters] = {address};
  if (size > hal::kMostRegisters) return false;
  std::copy_n(data, size, bytes + 1);
  i2c_msg part = {chip_, 0, static_cast<std::uint16_t>(1 + size), bytes};
  i2c_rdwr_ioctl_data messages{&part, 1};
  return transfer(messages);
}

bool I2cBus::transfer(i2c_rdwr_ioctl_data& messages) {
  if (descriptor_.get() < 0) descriptor_.reset(calls_.open(device_.c_str()));
  if (descriptor_.get() < 0) return false;
  if (calls_.transfer(descriptor_.get(), messages) == static_cast<int>(messages.nmsgs)) return true;
  if (errno == ENODEV || errno == EBADF) descriptor_.reset();
  return false;
}

}  // namespace verp::imu
