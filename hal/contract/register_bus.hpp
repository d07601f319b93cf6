#pragma once
#include <cstddef>
#include <cstdint>

/// RegisterBus: the registers of one chip, on I2C or behind a serial line.
///
/// A backend promises:
///  - read(address, data, size), write(address, data, size): 1 to kMostRegisters registers from
///    `address` on, in one transfer. True: the chip acknowledged all of it. False after at most
///    kRegisterMaxWait_us; a chip may have taken a write of which that is said.
///  - Each call starts anew: late bytes of an earlier answer never count.
///  - No call throws or allocates.
namespace verp::hal {

inline constexpr std::size_t kMostRegisters = 168;             ///< fourteen samples of twelve bytes
inline constexpr std::uint32_t kRegisterMaxWait_us = 150'000;  ///< with retries

class RegisterBus {
 public:
  virtual bool read(std::uint8_t address, std::uint8_t* data, std::size_t size) = 0;
  virtual bool write(std::uint8_t address, const std::uint8_t* data, std::size_t size) = 0;

 protected:
  ~RegisterBus() = default;
};

}  // namespace verp::hal
