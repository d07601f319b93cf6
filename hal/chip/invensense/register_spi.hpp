#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/chip/invensense/registers.hpp"
#include "hal/contract/register_bus.hpp"

namespace verp::hal::invensense {

/// MotionSensor's SPI over a RegisterBus, for chips on I2C.
class RegisterSpi {
 public:
  explicit RegisterSpi(RegisterBus& bus) : bus_(bus) {}
  bool exchange(const std::uint8_t* out, std::uint8_t* in, std::size_t size, std::uint32_t) {
    const auto address = static_cast<std::uint8_t>(out[0] & 0x7F);
    return (out[0] & 0x80) != 0 ? bus_.read(address, in + 1, size - 1)
                                : bus_.write(address, out + 1, size - 1);
  }

 private:
  RegisterBus& bus_;
};

struct I2cKinds {
  static constexpr const Kind* kAll[] = {&kMpu6050};
};

}  // namespace verp::hal::invensense
