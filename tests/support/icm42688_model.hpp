#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace verp::test {

/// Registers of an ICM-42688-P (DS-000347), bank 0. Time is the caller's.
class Icm42688Model {
 public:
  Icm42688Model() { reset(0); }

  // Script.
  bool silent = false;
  bool frozen = false;
  /// A dip of the supply.
  void dip(std::uint64_t now_us) { reset(now_us); }

  bool measures() const { return registers_[0x4E] == 0x0F; }
  /// A new sample, if the chip is awake.
  void measure(const std::int16_t (&gyro)[3], const std::int16_t (&accel)[3]) {
    if (!measures() || frozen) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      store(0x1F + 2 * axis, accel[axis]);
      store(0x25 + 2 * axis, gyro[axis]);
    }
    registers_[0x2D] |= 0x08;
  }

  bool read(std::uint8_t address, std::uint8_t* data, std::size_t size, std::uint64_t now_us) {
    if (silent || now_us < ready_us_) return false;
    for (std::size_t i = 0; i < size; ++i) data[i] = registers_.at(address + i);
    if (address <= 0x2D && address + size > 0x2D) registers_[0x2D] = 0;
    return true;
  }
  bool write(std::uint8_t address, const std::uint8_t* data, std::size_t, std::uint64_t now_us) {
    if (silent || now_us < ready_us_) return false;
    if (address == 0x11 && (data[0] & 1) != 0) return reset(now_us), true;
    registers_.at(address) = data[0];
    return true;
  }
  std::uint8_t reg(std::uint8_t address) const { return registers_.at(address); }

 private:
  void reset(std::uint64_t now_us) {
    registers_ = {};
    registers_[0x75] = 0x47;
    registers_[0x4F] = registers_[0x50] = 0x06;
    registers_[0x52] = 0x11;
    ready_us_ = now_us + 1'000;
  }
  void store(std::size_t at, std::int16_t count) {
    registers_[at] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(count) >> 8);
    registers_[at + 1] = static_cast<std::uint8_t>(count & 0xFF);
  }

  std::array<std::uint8_t, 128> registers_{};
  std::uint64_t ready_us_ = 0;
};

}  // namespace verp::test
