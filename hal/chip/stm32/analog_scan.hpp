#pragma once
#include <cstdint>

#include "hal/chip/stm32/analog_input.hpp"

/// Four ADC channels in turn, as counts of 16 bits: each the sum of 16 conversions. poll() never
/// waits; all four are new about every 0.4 ms if it is called often.
namespace verp::hal::stm32 {

struct ScanWiring {
  std::uint32_t base = 0;  ///< ADC1 to ADC3; 0: none
  std::uint32_t mask = 0;  ///< its bit in rcc::kApb2enr
  Pin pin[4];
  std::uint8_t channel[4] = {};  ///< 0 to 15
};

/// `Timer` is a TickTimer.
template <Io Access, class Timer>
class AnalogScan {
 public:
  AnalogScan(const ScanWiring& wiring, Timer& timer, Access io = {})
      : io_(io), wiring_(wiring), timer_(timer) {}

  /// Call once, first. `bus_hz` is the APB2 clock.
  void open(std::uint32_t bus_hz) {
    enable_clock(io_, rcc::kApb2enr, wiring_.mask);
    detail::set_adc_clock(io_, bus_hz);
    for (int i = 0; i < 4; ++i) {
      Gpio<Access>(io_).analog(wiring_.pin[i]);
      detail::set_sampling(io_, wiring_.base, wiring_.channel[i], k84Cycles);
    }
    io_.write32(wiring_.base + adc::kSqr1, 0);  // one conversion
    io_.write32(wiring_.base + adc::kCr2, adc::kCr2Adon);
    asked_us_ = timer_.now_us();
  }

  /// Fetches a conversion and starts the next. True: `counts` are new.
  bool poll(std::uint16_t (&counts)[4]) {
    const std::uint64_t now_us = timer_.now_us();
    const bool done = (io_.read32(wiring_.base + adc::kSr) & adc::kSrEoc) != 0;
    if (!done && now_us - asked_us_ < (asked_ ? kPatience_us : detail::kAdcPowerUp_us))
      return false;
    const bool whole = done && take(counts);
    if (!done && asked_) begin();  // the converter has stopped
    io_.write32(wiring_.base + adc::kSqr3, wiring_.channel[at_]);
    modify32(io_, wiring_.base + adc::kCr2, 0, adc::kCr2Swstart);
    asked_us_ = now_us;
    asked_ = true;
    return whole;
  }

 private:
  static constexpr std::uint32_t k84Cycles = 4;  ///< SMPR; a conversion takes 96 cycles
  static constexpr std::uint64_t kPatience_us = 200;
  static constexpr int kRounds = 16;

  bool take(std::uint16_t (&counts)[4]) {
    sum_[at_] += io_.read32(wiring_.base + adc::kDr) & 0xFFF;
    at_ = (at_ + 1) % 4;
    if (at_ != 0 || ++rounds_ < kRounds) return false;
    for (int i = 0; i < 4; ++i) counts[i] = static_cast<std::uint16_t>(sum_[i]);
    begin();
    return true;
  }
  void begin() {
    at_ = rounds_ = 0;
    for (std::uint32_t& sum : sum_) sum = 0;
  }

  [[no_unique_address]] Access io_;
  ScanWiring wiring_;
  Timer& timer_;
  std::uint64_t asked_us_ = 0;
  std::uint32_t sum_[4] = {};
  int at_ = 0;
  int rounds_ = 0;
  bool asked_ = false;
};

}  // namespace verp::hal::stm32
