#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/imu.hpp"
#include "hal/contract/register_bus.hpp"

/// A BNO055's gyroscope and accelerometer without its fusion. Facts: data sheet BST-BNO055-DS000.
/// Each collect() takes one step of the start-up or fetches the newest sample. After a silence it
/// finds the chip again, also one that lost its settings in a dip of its supply.
namespace verp::hal::bosch {

namespace bno055 {
inline constexpr std::uint8_t kChipIdAt = 0x00, kChipId = 0xA0;
inline constexpr std::uint8_t kAccelAt = 0x08;  ///< X, Y, Z, low byte first; 0x0E: compass
inline constexpr std::size_t kGyroAfter = 12;   ///< 0x14
inline constexpr std::size_t kDataSize = 18;
inline constexpr std::uint8_t kPageAt = 0x07, kModeAt = 0x3D, kTriggerAt = 0x3F;
inline constexpr std::uint8_t kConfigMode = 0, kAccelGyroMode = 5;
inline constexpr std::uint8_t kResetSystem = 0x20;

struct Setting {
  std::uint8_t page, address, value;
};
/// PWR_MODE: normal. UNIT_SEL: 0.01 m/s^2 and 1/16 deg/s per count, at any range. Axes as printed
/// on the chip. ACC_CONFIG: +-8 g, of which a step is such a count, 62.5 Hz. GYR_CONFIG_0: +-2000
/// deg/s, 47 Hz; below half of the slowest poll over a serial line. GYR_CONFIG_1: normal.
inline constexpr Setting kSettings[] = {{0, 0x3E, 0}, {0, 0x3B, 0},    {0, 0x41, 0x24},
                                        {0, 0x42, 0}, {1, 0x08, 0x0E}, {1, 0x0A, 3 << 3 | 0},
                                        {1, 0x0B, 0}};
}  // namespace bno055

/// `Clock` has now_us(). A sample is new if a count changed: the chip's noise is above a count.
template <class Clock>
class Bno055 {
 public:
  Bno055(RegisterBus& bus, const Clock& clock) : bus_(bus), clock_(clock) {}

  /// Adds a new sample to `mean`: kFresh, and sets time_us. Call it at least as often as samples
  /// come (100 to 400 Hz), or they are passed over.
  ImuStatus collect(ImuMean& mean, std::uint64_t& time_us) {
    if (clock_.now_us() < ready_us_) return ImuStatus::kStale;
    switch (phase_) {
      case Phase::kSearch:
        return search();
      case Phase::kConfiguring:
        return step(configure(), Phase::kStarting, kModeSwitch_us);
      case Phase::kStarting:
        alive_us_ = clock_.now_us();
        return step(is_in_mode(), Phase::kRunning, 0);
      case Phase::kRunning:
      default:
        return fetch(mean, time_us);
    }
  }

 private:
  enum class Phase : std::uint8_t { kSearch, kConfiguring, kStarting, kRunning };
  /// 650 ms typical (table 0-2), and a margin, because nothing says the longest.
  static constexpr std::uint64_t kReset_us = 800'000;
  static constexpr std::uint64_t kModeSwitch_us = 20'000;  ///< 19 ms (table 3-6)
  static constexpr std::uint64_t kDoubt_us = 20'000;       ///< two of the slowest samples
  static constexpr std::uint64_t kSilence_us = 100'000;    ///< the chip has stopped

  /// Resets a chip that another program set up, or that stopped.
  ImuStatus search() {
    if (!is_there()) return ImuStatus::kFault;
    if (needs_reset_) {
      put(bno055::kTriggerAt, bno055::kResetSystem);  // it may reset before it answers
      needs_reset_ = false;
      return step(true, Phase::kSearch, kReset_us);
    }
    return step(put(bno055::kModeAt, bno055::kConfigMode), Phase::kConfiguring, kModeSwitch_us);
  }
  ImuStatus step(bool done, Phase next, std::uint64_t then_us) {
    if (!done) return restart(true);
    phase_ = next;
    ready_us_ = clock_.now_us() + then_us;
    return ImuStatus::kStale;
  }
  ImuStatus restart(bool with_reset) {
    phase_ = Phase::kSearch;
    needs_reset_ = needs_reset_ || with_reset;
    return ImuStatus::kFault;
  }

  bool put(std::uint8_t address, std::uint8_t value) { return bus_.write(address, &value, 1); }
  bool holds(std::uint8_t address, std::uint8_t value) {
    std::uint8_t got = 0;
    return bus_.read(address, &got, 1) && got == value;
  }
  bool is_there() { return put(bno055::kPageAt, 0) && holds(bno055::kChipIdAt, bno055::kChipId); }
  bool is_in_mode() { return holds(bno055::kModeAt, bno055::kAccelGyroMode); }
  bool configure() {
    for (const bno055::Setting& each : bno055::kSettings) {
      if (!put(bno055::kPageAt, each.page) || !put(each.address, each.value) ||
          !holds(each.address, each.value)) {
        return false;
      }
    }
    return put(bno055::kPageAt, 0) && put(bno055::kModeAt, bno055::kAccelGyroMode);
  }

  // One transfer, so that all counts are of one time. In CONFIG mode, where a dip of the supply
  // leaves the chip, all of them are 0 (section 3.3.1).
  ImuStatus fetch(ImuMean& mean, std::uint64_t& time_us) {
    std::uint8_t data[bno055::kDataSize];
    if (!bus_.read(bno055::kAccelAt, data, sizeof data)) return ImuStatus::kFault;
    const std::uint64_t now_us = clock_.now_us();
    ImuSample sample;
    bool is_zero = true, is_new = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int16_t accel = count(data + 2 * axis);
      const std::int16_t gyro = count(data + bno055::kGyroAfter + 2 * axis);
      is_zero = is_zero && accel == 0 && gyro == 0;
      is_new = is_new || accel != last_.accel_count[axis] || gyro != last_.gyro_count[axis];
      sample.accel_count[axis] = accel;
      sample.gyro_count[axis] = gyro;
    }
    if (is_new && !is_zero) {
      last_ = sample;
      mean.add(sample);
      time_us = alive_us_ = now_us;
      return ImuStatus::kFresh;
    }
    const std::uint64_t silence_us = now_us - alive_us_;
    if ((is_zero || silence_us > kDoubt_us) && !is_in_mode()) return restart(false);
    if (silence_us > kSilence_us) return restart(true);
    return ImuStatus::kStale;
  }
  static std::int16_t count(const std::uint8_t* data) {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(data[1] << 8 | data[0]));
  }

  RegisterBus& bus_;
  const Clock& clock_;
  ImuSample last_;
  std::uint64_t ready_us_ = 0;  ///< when the chip has executed the last command
  std::uint64_t alive_us_ = 0;  ///< when a count last changed
  Phase phase_ = Phase::kSearch;
  bool needs_reset_ = true;
};

}  // namespace verp::hal::bosch
