#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "hal/chip/invensense/registers.hpp"
#include "hal/contract/imu.hpp"

/// An MPU-9250 or ICM-20648 behind SPI as an Imu; it finds out which. Each read() does one step of
/// the way from a reset chip to samples, or fetches one, and never waits for the chip: after a
/// fault it begins anew, and is kStale for the 150 ms that the chip takes to come up.
namespace verp::hal::invensense {

/// exchange(out, in, size, max_hz): bytes both ways in one selection, at most at that clock; false:
/// it did not work. Ends within twice the bytes' time and 20 us.
template <class Spi>
concept SpiBus = requires(Spi& spi, const std::uint8_t* out, std::uint8_t* in, std::size_t size,
                          std::uint32_t max_hz) {
  { spi.exchange(out, in, size, max_hz) } -> std::same_as<bool>;
};

/// `Clock` has now_us(), the board's TickSource. A sample's time is that of its fetching: it is at
/// most one sample period, 2 ms, older.
template <SpiBus Spi, class Clock>
class MotionSensor {
 public:
  MotionSensor(Spi& spi, const Clock& clock, const Ranges& ranges = {})
      : spi_(spi), clock_(clock), ranges_(ranges) {}

  ImuStatus read(ImuSample& sample) {
    switch (phase_) {
      case Phase::kSearch:
        return search() ? ImuStatus::kStale : fault();
      case Phase::kResetting:
        return step(Phase::kStarting, kStart_us, [this] { return wake(); });
      case Phase::kStarting:
        return step(Phase::kRunning, 0, [this] { return configure(); });
      case Phase::kRunning:
      default:
        return fetch(sample);
    }
  }
  std::uint32_t faults() const { return faults_; }

 private:
  enum class Phase : std::uint8_t { kSearch, kResetting, kStarting, kRunning };
  /// After DEVICE_RESET: both data sheets, "start-up time for register read/write", 100 ms at most.
  static constexpr std::uint64_t kReset_us = 100'000;
  /// From sleep to valid rates: 35 ms typically (both data sheets), and what the filter takes.
  static constexpr std::uint64_t kStart_us = 50'000;
  /// Fifty sample periods without a sample: it has stopped.
  static constexpr std::uint64_t kSilence_us = 100'000;
  static constexpr std::uint8_t kRead = 0x80;
  static constexpr std::size_t kMostData = 14;

  ImuStatus fault() {
    phase_ = Phase::kSearch;
    ++faults_;
    return ImuStatus::kFault;
  }

  bool search() {
    for (const Kind* kind : {&kMpu9250, &kIcm20648}) {
      kind_ = kind;
      bank_ = kUnknownBank;
      if (!is_there()) continue;
      if (!write(0, kind_->power, kReset)) return false;
      bank_ = 0;
      ready_us_ = clock_.now_us() + kReset_us;
      phase_ = Phase::kResetting;
      return true;
    }
    return false;
  }

  template <class Work>
  ImuStatus step(Phase next, std::uint64_t then_us, Work&& work) {
    const std::uint64_t now_us = clock_.now_us();
    if (now_us < ready_us_) return ImuStatus::kStale;
    if (!work()) return fault();
    phase_ = next;
    ready_us_ = fresh_us_ = now_us + then_us;
    return ImuStatus::kStale;
  }
  bool is_there() {
    std::uint8_t who = 0;
    return select_bank(0) && fetch_bytes(kind_->who_am_i_at, &who, 1, registers_hz()) &&
           who == kind_->who_am_i;
  }
  bool wake() {
    return is_there() && write(0, kind_->user_control, kI2cOff) &&
           write(0, kind_->power, kAutoClock);
  }
  bool configure() {
    for (std::size_t i = 0; i < kind_->setting_count; ++i) {
      const Setting& setting = kind_->settings[i];
      const std::uint8_t wanted = setting.with(ranges_);
      std::uint8_t got = 0;
      if (!write(setting.bank, setting.address, wanted) ||
          !fetch_bytes(setting.address, &got, 1, registers_hz()) || got != wanted) {
        return false;
      }
    }
    return select_bank(0) && keeps_settings();
  }
  bool keeps_settings() {
    std::uint8_t guard = 0;
    return fetch_bytes(kind_->guard_at, &guard, 1, registers_hz()) && guard == kind_->guard;
  }

  // A sample that comes between the status and the data would be told again by the next status: if
  // one has come, the data is fetched once more. The chip holds them still within each exchange.
  ImuStatus fetch(ImuSample& sample) {
    std::uint8_t data[kMostData];
    bool ready = false, again = false;
    if (!has_sample(ready)) return fault();
    const std::uint64_t now_us = clock_.now_us();
    if (ready && !(fetch_data(data) && has_sample(again) && (!again || fetch_data(data)))) {
      return fault();
    }
    if (!keeps_settings()) return fault();
    if (!ready) return now_us - fresh_us_ > kSilence_us ? fault() : ImuStatus::kStale;
    const std::size_t gyro = std::size_t{kind_->gyro_at} - kind_->accel_at;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sample.accel_count[axis] = count(data + 2 * axis);
      sample.gyro_count[axis] = count(data + gyro + 2 * axis);
    }
    sample.time_us = fresh_us_ = now_us;
    return ImuStatus::kFresh;
  }
  bool has_sample(bool& ready) {
    std::uint8_t status = 0;
    if (!fetch_bytes(kind_->status, &status, 1, kind_->data_hz)) return false;
    ready = (status & kDataReady) != 0;
    return true;
  }
  bool fetch_data(std::uint8_t* data) {
    const std::size_t size = std::size_t{kind_->gyro_at} - kind_->accel_at + 6;
    return fetch_bytes(kind_->accel_at, data, size, kind_->data_hz);
  }
  static std::int16_t count(const std::uint8_t* data) {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(data[0] << 8 | data[1]));
  }

  // Who is not known yet must bear it, whoever it is.
  std::uint32_t registers_hz() const {
    return phase_ == Phase::kSearch ? kMpu9250.registers_hz : kind_->registers_hz;
  }
  bool select_bank(std::uint8_t bank) {
    if (!kind_->has_banks || bank == bank_) return true;
    bank_ = bank;
    return write_bytes(kBankSelect, static_cast<std::uint8_t>(bank << 4));
  }
  bool write(std::uint8_t bank, std::uint8_t address, std::uint8_t value) {
    return select_bank(bank) && write_bytes(address, value);
  }
  bool write_bytes(std::uint8_t address, std::uint8_t value) {
    const std::uint8_t out[2] = {address, value};
    std::uint8_t in[2];
    return spi_.exchange(out, in, 2, registers_hz());
  }
  bool fetch_bytes(std::uint8_t address, std::uint8_t* to, std::size_t size, std::uint32_t max_hz) {
    std::uint8_t out[1 + kMostData] = {static_cast<std::uint8_t>(address | kRead)};
    std::uint8_t in[1 + kMostData];
    if (!spi_.exchange(out, in, 1 + size, max_hz)) return false;
    __builtin_memcpy(to, in + 1, size);
    return true;
  }

  static constexpr std::uint8_t kUnknownBank = 0xFF;

  Spi& spi_;
  const Clock& clock_;
  Ranges ranges_;
  const Kind* kind_ = &kMpu9250;
  std::uint64_t ready_us_ = 0;  ///< when the chip will have done what it was told
  std::uint64_t fresh_us_ = 0;  ///< when the last sample was fetched
  std::uint32_t faults_ = 0;
  Phase phase_ = Phase::kSearch;
  std::uint8_t bank_ = kUnknownBank;  ///< that the chip shows
};

}  // namespace verp::hal::invensense
