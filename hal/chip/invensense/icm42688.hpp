#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/imu.hpp"
#include "hal/contract/register_bus.hpp"

/// An ICM-42688-P over any RegisterBus. Facts: data sheet DS-000347. +-2000 deg/s, +-4 g, 500
/// samples a second, low pass of 25 Hz.
namespace verp::hal::invensense {

namespace icm42688 {
inline constexpr std::uint8_t kWhoAmIAt = 0x75, kWhoAmI = 0x47;
inline constexpr std::uint8_t kBankAt = 0x76;     ///< all registers here are of bank 0
inline constexpr std::uint8_t kResetAt = 0x11;    ///< DEVICE_CONFIG, bit 0
inline constexpr std::uint8_t kStatusAt = 0x2D;   ///< INT_STATUS; reading clears it
inline constexpr std::uint8_t kDataReady = 0x08;  ///< INT_STATUS
inline constexpr std::uint8_t kDataAt = 0x1F;     ///< acceleration, then rates, high byte first
inline constexpr std::size_t kDataSize = 12;

struct Setting {
  std::uint8_t address, value;
};
/// GYRO_CONFIG0: +-2000 deg/s, 500 Hz. ACCEL_CONFIG0: +-4 g, 500 Hz. GYRO_ACCEL_CONFIG0: both a
/// twentieth of that. PWR_MGMT0: both on, low noise; last, because the rest is not for a running
/// chip.
inline constexpr Setting kSettings[] = {
    {0x4F, 0x0F}, {0x50, 2 << 5 | 0x0F}, {0x52, 0x66}, {0x4E, 0x0F}};
}  // namespace icm42688

/// `Clock` has now_us(). Each collect() takes one step of the start-up or fetches a sample.
template <class Clock>
class Icm42688 {
 public:
  Icm42688(RegisterBus& bus, const Clock& clock) : bus_(bus), clock_(clock) {}

  /// Adds a new sample to `mean`: kFresh, and sets time_us.
  ImuStatus collect(ImuMean& mean, std::uint64_t& time_us) {
    if (clock_.now_us() < ready_us_) return ImuStatus::kStale;
    switch (phase_) {
      case Phase::kSearch:
        if (!is_there()) return ImuStatus::kFault;
        put(icm42688::kResetAt, 1);
        return step(true, Phase::kConfiguring, kReset_us);
      case Phase::kConfiguring:
        return step(is_there() && configure(), Phase::kRunning, kStart_us);
      case Phase::kRunning:
      default:
        return fetch(mean, time_us);
    }
  }

 private:
  enum class Phase : std::uint8_t { kSearch, kConfiguring, kRunning };
  static constexpr std::uint64_t kReset_us = 10'000;     ///< 1 ms (14.1), and a margin
  static constexpr std::uint64_t kStart_us = 60'000;     ///< gyro: 45 ms on (14.36), and the filter
  static constexpr std::uint64_t kSilence_us = 100'000;  ///< fifty samples: the chip has stopped

  /// A chip that lost its settings in a dip of its supply sleeps: no sample, as if it had stopped.
  ImuStatus step(bool done, Phase next, std::uint64_t then_us) {
    phase_ = done ? next : Phase::kSearch;
    alive_us_ = ready_us_ = clock_.now_us() + then_us;
    return done ? ImuStatus::kStale : ImuStatus::kFault;
  }
  bool put(std::uint8_t address, std::uint8_t value) { return bus_.write(address, &value, 1); }
  bool holds(std::uint8_t address, std::uint8_t value) {
    std::uint8_t got = 0;
    return bus_.read(address, &got, 1) && got == value;
  }
  bool is_there() {
    return put(icm42688::kBankAt, 0) && holds(icm42688::kWhoAmIAt, icm42688::kWhoAmI);
  }
  bool configure() {
    for (const icm42688::Setting& each : icm42688::kSettings) {
      if (!put(each.address, each.value) || !holds(each.address, each.value)) return false;
    }
    return true;
  }

  ImuStatus fetch(ImuMean& mean, std::uint64_t& time_us) {
    std::uint8_t status = 0, data[icm42688::kDataSize];
    if (!bus_.read(icm42688::kStatusAt, &status, 1)) return ImuStatus::kFault;
    const std::uint64_t now_us = clock_.now_us();
    if ((status & icm42688::kDataReady) == 0) {
      return now_us > alive_us_ + kSilence_us ? step(false, Phase::kSearch, 0) : ImuStatus::kStale;
    }
    if (!bus_.read(icm42688::kDataAt, data, sizeof data)) return ImuStatus::kFault;
    ImuSample sample;
    for (int axis = 0; axis < 3; ++axis) {
      sample.accel_count[axis] = count(data + 2 * axis);
      sample.gyro_count[axis] = count(data + 6 + 2 * axis);
    }
    mean.add(sample);
    time_us = alive_us_ = now_us;
    return ImuStatus::kFresh;
  }
  static std::int16_t count(const std::uint8_t* data) {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(data[0] << 8 | data[1]));
  }

  RegisterBus& bus_;
  const Clock& clock_;
  std::uint64_t ready_us_ = 0;  ///< when the chip has executed the last command
  std::uint64_t alive_us_ = 0;  ///< when the last sample came
  Phase phase_ = Phase::kSearch;
};

}  // namespace verp::hal::invensense
