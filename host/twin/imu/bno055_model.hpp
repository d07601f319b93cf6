#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "host/twin/sim/plant.hpp"

namespace verp::imu {

/// A BNO055's registers (BST-BNO055-DS000) in the modes CONFIG and ACCGYRO; fusion and compass stay
/// zero. Time is the caller's.
class Bno055Model {
 public:
  Bno055Model();

  // Script.
  bool silent = false;
  bool frozen = false;  ///< takes no sample
  int chip_id = 0xA0;
  /// A dip of the supply: the settings are lost, and the chip is silent for 650 ms.
  void dip(std::uint64_t now_us) { reset(now_us); }

  /// A new sample, in the chip's counts.
  void measure(const sim::ImuMeasurement& counts);
  /// Like noise of one count, so that no two samples are alike.
  bool noisy = true;

  /// False: no acknowledgement.
  bool read(std::uint8_t address, std::uint8_t* data, std::size_t size, std::uint64_t now_us);
  bool write(std::uint8_t address, const std::uint8_t* data, std::size_t size,
             std::uint64_t now_us);

  bool measures() const { return registers_[0][kMode] == kAccelGyro; }
  std::uint8_t reg(std::size_t page, std::uint8_t address) const {
    return registers_[page][address];
  }
  /// Accesses that the data sheet forbids.
  std::uint32_t violations() const { return violations_; }

 private:
  static constexpr std::uint8_t kChip = 0x00, kPage = 0x07, kData = 0x08, kUnits = 0x3B,
                                kMode = 0x3D, kTrigger = 0x3F, kAxisMap = 0x41, kConfig = 0,
                                kAccelGyro = 5;
  void reset(std::uint64_t now_us);
  void put(std::uint8_t address, std::uint8_t value, std::uint64_t now_us);
  void set_mode(std::uint8_t mode, std::uint64_t now_us);

  std::array<std::array<std::uint8_t, 128>, 2> registers_{};
  std::size_t page_ = 0;
  std::uint64_t ready_us_ = 0;   ///< end of a reset
  std::uint64_t switch_us_ = 0;  ///< end of a change of mode
  std::uint32_t violations_ = 0;
  std::uint32_t noise_ = 0;
};

}  // namespace verp::imu
