#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "hal/chip/invensense/registers.hpp"
#include "hal/contract/imu.hpp"

/// An MPU-9250 or ICM-20648 behind SPI as an Imu; the driver detects which. Each read() takes one
/// step of the start-up or fetches the FIFO, and never waits. After a fault it restarts the chip
/// and returns kStale for 150 ms.
///
/// A landing foot jolts the body for less than a tick. One sample a tick would falsify the
/// integrated rotation; hence the mean.
namespace verp::hal::invensense {

/// exchange(out, in, size, max_hz): bytes both ways in one selection, at most at max_hz; false on
/// failure. `in` may equal `out`. Takes at most twice the bytes' time plus 20 us.
template <class Spi>
concept SpiBus = requires(Spi& spi, const std::uint8_t* out, std::uint8_t* in, std::size_t size,
                          std::uint32_t max_hz) {
  { spi.exchange(out, in, size, max_hz) } -> std::same_as<bool>;
};

struct SpiKinds {
  static constexpr const Kind* kAll[] = {&kMpu9250, &kIcm20648};
};

/// `Clock` has now_us(), the board's TickSource. A sample's time is when it was fetched; it may be
/// one sample period (2 ms) older.
template <SpiBus Spi, class Clock, class Kinds = SpiKinds>
class MotionSensor {
 public:
  MotionSensor(Spi& spi, const Clock& clock, const Ranges& ranges = {})
      : spi_(spi), clock_(clock), ranges_(ranges) {}

  ImuStatus read(ImuSample& sample) {
    ImuMean mean;
    std::uint64_t time_us = 0;
    const ImuStatus status = collect(mean, time_us);
    if (status != ImuStatus::kFresh) return status;
    mean.take(sample);
    sample.time_us = time_us;
    return status;
  }
  /// A read that leaves the mean to the caller: kFresh adds the samples and sets time_us.
  ImuStatus collect(ImuMean& mean, std::uint64_t& time_us) {
    switch (phase_) {
      case Phase::kSearch:
        return search() ? ImuStatus::kStale : fault();
      case Phase::kResetting:
        return step(Phase::kStarting, kStart_us, [this] { return wake(); });
      case Phase::kStarting:
        return step(Phase::kRunning, 0, [this] { return configure(); });
      case Phase::kRunning:
      default:
        return fetch(mean, time_us);
    }
  }
  std::uint32_t faults() const { return faults_; }

 private:
  enum class Phase : std::uint8_t { kSearch, kResetting, kStarting, kRunning };
  /// Longest time after DEVICE_RESET (both data sheets, "start-up time for register read/write").
  static constexpr std::uint64_t kReset_us = 100'000;
  /// From sleep to valid rates: 35 ms typical (both data sheets), plus the filter.
  static constexpr std::uint64_t kStart_us = 50'000;
  /// Fifty sample periods: the chip has stopped.
  static constexpr std::uint64_t kSilence_us = 100'000;
  static constexpr std::uint8_t kRead = 0x80;
  static constexpr std::size_t kSampleSize = 12;
  /// kImuMostPause_us of samples, plus one for the rate's tolerance. Far below the FIFO's 512
  /// bytes, so the driver never trusts a full FIFO.
  static constexpr std::size_t kMostSize = 14 * kSampleSize;

  ImuStatus fault() {
    phase_ = Phase::kSearch;
    overfull_ = false;
    ++faults_;
    return ImuStatus::kFault;
  }

  bool search() {
    for (const Kind* kind : Kinds::kAll) {
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
    ready_us_ = alive_us_ = now_us + then_us;
    return ImuStatus::kStale;
  }
  bool is_there() {
    std::uint8_t who = 0;
    return select_bank(0) && fetch_register(kind_->who_am_i_at, who) && who == kind_->who_am_i;
  }
  bool wake() {
    return is_there() && write(0, kind_->user_control, kind_->port) &&
           write(0, kind_->power, kAutoClock);
  }
  bool configure() {
    for (std::size_t i = 0; i < kind_->setting_count; ++i) {
      const Setting& setting = kind_->settings[i];
      const std::uint8_t wanted = setting.with(ranges_);
      std::uint8_t got = 0;
      if (!write(setting.bank, setting.address, wanted) || !fetch_register(setting.address, got) ||
          got != wanted) {
        return false;
      }
    }
    return empty_fifo() && keeps_settings();
  }
  bool keeps_settings() {
    std::uint8_t guard = 0;
    return fetch_register(kind_->guard_at, guard) && guard == kind_->guard;
  }
  bool empty_fifo() {
    for (const Setting& setting : kind_->empty_fifo) {
      if (!write(setting.bank, setting.address, setting.value)) return false;
    }
    return true;
  }

  // Empties a FIFO that holds too much (after a pause) or is out of step: its bytes would belong to
  // other axes. The guard register, read last, vouches for the data.
  ImuStatus fetch(ImuMean& mean, std::uint64_t& time_us) {
    std::uint8_t data[1 + kMostSize] = {};
    std::size_t size = 0;
    if (!fetch_size(size)) return fault();
    const std::uint64_t now_us = clock_.now_us();
    const bool fits = size <= kMostSize, in_step = size % kSampleSize == 0;
    const bool done = fits && in_step ? fetch_fifo(data, size) : empty_fifo();
    if (!done || !keeps_settings()) return fault();
    if (fits ? in_step && size > 0 : !overfull_) alive_us_ = now_us;
    overfull_ = !fits;  // once: a pause; twice: it does not empty
    if (now_us - alive_us_ > kSilence_us) return fault();
    if (!fits || !in_step || size == 0) return ImuStatus::kStale;
    add(data + 1, size, mean);
    time_us = now_us;
    return ImuStatus::kFresh;
  }
  /// Reads the size twice if a sample is just being written.
  bool fetch_size(std::size_t& size) {
    return look_at_size(size) && (size % kSampleSize == 0 || look_at_size(size));
  }
  bool look_at_size(std::size_t& size) {
    std::uint8_t data[3] = {};
    if (!fetch_bytes(kind_->fifo_size_at, data, 2, kind_->data_hz)) return false;
    size = std::size_t{data[1]} << 8 | data[2];
    return true;
  }
  bool fetch_fifo(std::uint8_t* data, std::size_t size) {
    return size == 0 || fetch_bytes(kind_->fifo_at, data, size, kind_->data_hz);
  }
  static void add(const std::uint8_t* data, std::size_t size, ImuMean& mean) {
    for (const std::uint8_t* const end = data + size; data != end; data += kSampleSize) {
      ImuSample one;
      for (int axis = 0; axis < 3; ++axis) {
        one.accel_count[axis] = count(data + 2 * axis);
        one.gyro_count[axis] = count(data + 6 + 2 * axis);
      }
      mean.add(one);
    }
  }
  static std::int16_t count(const std::uint8_t* data) {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(data[0] << 8 | data[1]));
  }

  // Until the chip is known, uses the clock that both kinds accept.
  std::uint32_t registers_hz() const {
    return phase_ == Phase::kSearch ? Kinds::kAll[0]->registers_hz : kind_->registers_hz;
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
  bool fetch_register(std::uint8_t address, std::uint8_t& value) {
    std::uint8_t data[2] = {};
    if (!fetch_bytes(address, data, 1, registers_hz())) return false;
    value = data[1];
    return true;
  }
  /// `data` has `size` + 1 bytes: the address first.
  bool fetch_bytes(std::uint8_t address, std::uint8_t* data, std::size_t size,
                   std::uint32_t max_hz) {
    data[0] = static_cast<std::uint8_t>(address | kRead);
    return spi_.exchange(data, data, 1 + size, max_hz);
  }

  static constexpr std::uint8_t kUnknownBank = 0xFF;

  Spi& spi_;
  const Clock& clock_;
  Ranges ranges_;
  const Kind* kind_ = Kinds::kAll[0];
  std::uint64_t ready_us_ = 0;  ///< when the chip has executed the last command
  std::uint64_t alive_us_ = 0;  ///< when the FIFO last held samples
  std::uint32_t faults_ = 0;
  Phase phase_ = Phase::kSearch;
  std::uint8_t bank_ = kUnknownBank;  ///< bank that is selected
  bool overfull_ = false;             ///< the FIFO held too much at the last read
};

}  // namespace verp::hal::invensense
