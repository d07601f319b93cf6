#pragma once
#include <cstdint>

#include "hal/chip/stm32/clock_gate.hpp"
#include "hal/chip/stm32/gpio.hpp"
#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/adc.hpp"
#include "hal/chip/stm32/registers/rcc.hpp"

/// One ADC channel as a slow voltage; poll_mv() never waits.
namespace verp::hal::stm32 {

struct AnalogWiring {
  std::uint32_t base = 0;  ///< ADC1 to ADC3; 0: none
  std::uint32_t mask = 0;  ///< its bit in rcc::kApb2enr
  Pin pin;
  std::uint8_t channel = 0;         ///< 0 to 15
  std::uint32_t full_scale_mv = 0;  ///< voltage before the divider for 4096 counts

  constexpr bool exists() const { return base != 0; }
};

namespace detail {

/// DS8626, ADC characteristics: 36 MHz, 3 us to power up; F446 and F746 likewise.
inline constexpr std::uint32_t kAdcMost_hz = 36'000'000;
inline constexpr std::uint64_t kAdcPowerUp_us = 4;

/// The converters share one divider. `bus_hz` is the APB2 clock.
template <Io Access>
void set_adc_clock(Access& io, std::uint32_t bus_hz) {
  std::uint32_t divider = 0;  // ADC clock = APB2 / (2 * (divider + 1))
  while (divider < 3 && bus_hz / (2 * (divider + 1)) > kAdcMost_hz) ++divider;
  modify32(io, base::kAdcCommon + adc::kCommonCcr, adc::kCcrAdcpre,
           divider << adc::kCcrAdcpreShift);
}
/// `code`: of SMPR.
template <Io Access>
void set_sampling(Access& io, std::uint32_t base, unsigned channel, std::uint32_t code) {
  const bool upper = channel >= 10;
  const unsigned shift = 3u * (channel - (upper ? 10u : 0u));
  modify32(io, base + (upper ? adc::kSmpr1 : adc::kSmpr2), 7u << shift, code << shift);
}

}  // namespace detail

/// `Timer` is a TickTimer.
template <Io Access, class Timer>
class AnalogInput {
 public:
  AnalogInput(const AnalogWiring& wiring, Timer& timer, Access io = {})
      : io_(io), wiring_(wiring), timer_(timer) {}

  /// Call once, first. `bus_hz` is the APB2 clock.
  void open(std::uint32_t bus_hz) {
    if (!wiring_.exists()) return;
    enable_clock(io_, rcc::kApb2enr, wiring_.mask);
    Gpio<Access>(io_).analog(wiring_.pin);
    detail::set_adc_clock(io_, bus_hz);
    detail::set_sampling(io_, wiring_.base, wiring_.channel, kLongest);
    io_.write32(at(adc::kSqr1), 0);  // one conversion
    io_.write32(at(adc::kSqr3), wiring_.channel);
    io_.write32(at(adc::kCr2), adc::kCr2Adon);
    asked_us_ = timer_.now_us();
  }

  /// Fetches a conversion and starts the next. Returns the running mean of about kWeight results;
  /// 0: none yet, or the converter has stopped.
  std::uint32_t poll_mv() {
    if (!wiring_.exists()) return 0;
    const std::uint64_t now_us = timer_.now_us();
    const bool done = (io_.read32(at(adc::kSr)) & adc::kSrEoc) != 0;
    if (!done && now_us - asked_us_ < (asked_ ? kPatience_us : detail::kAdcPowerUp_us))
      return mean_mv();
    if (done) {
      take(io_.read32(at(adc::kDr)) & 0xFFF);
    } else if (asked_) {
      sum_ = 0;
      ++timeouts_;
    }
    modify32(io_, at(adc::kCr2), 0, adc::kCr2Swstart);
    asked_us_ = now_us;
    asked_ = true;
    return mean_mv();
  }
  /// Timeouts of conversions, modulo 2^32.
  std::uint32_t timeouts() const { return timeouts_; }

 private:
  /// A conversion takes 492 cycles of at least 2 MHz (APB2 16 MHz / 8).
  static constexpr std::uint64_t kPatience_us = 1000;
  static constexpr std::uint32_t kLongest = 7;  ///< SMPR: 480 cycles, for a divider of 100 kohm
  static constexpr std::uint32_t kWeight = 16;

  std::uint32_t at(std::uint32_t offset) const { return wiring_.base + offset; }
  void take(std::uint32_t count) {
    sum_ = sum_ == 0 ? count * kWeight : sum_ - sum_ / kWeight + count;
  }
  std::uint32_t mean_mv() const {
    constexpr std::uint32_t kAll = 4096 * kWeight;
    return static_cast<std::uint32_t>((std::uint64_t{sum_} * wiring_.full_scale_mv + kAll / 2) /
                                      kAll);
  }

  [[no_unique_address]] Access io_;
  AnalogWiring wiring_;
  Timer& timer_;
  std::uint64_t asked_us_ = 0;
  std::uint32_t sum_ = 0;  ///< kWeight times the mean; 0: none
  std::uint32_t timeouts_ = 0;
  bool asked_ = false;
};

}  // namespace verp::hal::stm32
