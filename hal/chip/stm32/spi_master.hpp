#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/chip/stm32/clock_gate.hpp"
#include "hal/chip/stm32/gpio.hpp"
#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/rcc.hpp"
#include "hal/chip/stm32/registers/spi.hpp"

/// One device on a chip-select pin: mode 3, 8 bits, MSB first. Polled: it writes a byte only after
/// the previous one came back, so an interrupt only delays a transfer. Every wait ends; an error
/// resets the peripheral.
namespace verp::hal::stm32 {

struct SpiWiring {
  std::uint32_t base = 0;
  std::uint32_t enable_register = 0;  ///< such as rcc::kApb2enr
  std::uint32_t mask = 0;             ///< its bit, the same in the reset register
  Pin clock;
  Pin data_in;  ///< MISO
  Pin data_out;
  Pin select;                  ///< chip select, active low
  std::uint32_t function = 0;  ///< alternate function of the first three pins
};

/// Modulo 2^32.
struct SpiErrors {
  std::uint32_t timeouts = 0;     ///< a flag did not come, or BSY did not clear
  std::uint32_t overruns = 0;     ///< a received byte was not fetched
  std::uint32_t mode_faults = 0;  ///< another bus master detected (MODF)
};

/// `Timer` is a TickTimer.
template <Io Access, class Timer>
class SpiMaster {
 public:
  SpiMaster(Family family, const SpiWiring& wiring, Timer& timer, Access io = {})
      : io_(io), gpio_(io), family_(family), wiring_(wiring), timer_(timer) {}

  /// Call once, first. `bus_hz` clocks the peripheral.
  void open(std::uint32_t bus_hz) {
    bus_hz_ = bus_hz;
    gpio_.output(wiring_.select, true);
    enable_clock(io_, wiring_.enable_register, wiring_.mask);
    restart();
    gpio_.alternate(wiring_.clock, wiring_.function);
    gpio_.alternate(wiring_.data_in, wiring_.function, gpio::kPullUp);
    gpio_.alternate(wiring_.data_out, wiring_.function);
  }

  /// Selects the device and exchanges `size` bytes at the highest clock up to max_hz. False: it
  /// failed and `in` is invalid. Takes at most twice the bytes' time plus kSlack_us.
  bool exchange(const std::uint8_t* out, std::uint8_t* in, std::size_t size, std::uint32_t max_hz) {
    if (!clean()) restart();
    const std::uint32_t clock_hz = set_clock(max_hz);
    deadline_us_ = timer_.now_us() + kSlack_us + std::uint64_t{2 * 8 * 1'000'000} * size / clock_hz;
    gpio_.write(wiring_.select, false);
    bool good = true;
    for (std::size_t i = 0; good && i < size; ++i) good = exchange_byte(out[i], in[i]);
    good = good && wait_for(spi::kSrBsy, 0) && !has_errors();
    if (!good) {
      count_errors();
      restart();  // stops the clock before the device is deselected
    }
    gpio_.write(wiring_.select, true);
    return good;
  }

  const SpiErrors& errors() const { return errors_; }

  static constexpr std::uint32_t kSlack_us = 20;

 private:
  static constexpr std::uint32_t kErrors = spi::kSrOvr | spi::kSrModf;
  /// SSI replaces the select input, which must be high.
  static constexpr std::uint32_t kControl =
      spi::kCr1Mstr | spi::kCr1Cpol | spi::kCr1Cpha | spi::kCr1Ssm | spi::kCr1Ssi;
  static constexpr std::uint32_t kSlowest = 7;  ///< BR: bus clock / 256

  std::uint32_t status() { return io_.read32(wiring_.base + spi::kSr); }
  bool has_errors() { return (status() & kErrors) != 0; }

  bool clean() {
    const std::uint32_t flags = status();
    if ((flags & (kErrors | spi::kSrBsy | spi::kSrRxne)) == 0) return true;
    count_errors();
    return false;
  }
  void count_errors() {
    const std::uint32_t flags = status();
    if ((flags & spi::kSrOvr) != 0) ++errors_.overruns;
    if ((flags & spi::kSrModf) != 0) ++errors_.mode_faults;
    if ((flags & kErrors) == 0) ++errors_.timeouts;
  }

  void restart() {
    constexpr std::uint32_t kResetBelow = rcc::kApb2enr - rcc::kApb2rstr;
    const std::uint32_t reset = base::kRcc + wiring_.enable_register - kResetBelow;
    modify32(io_, reset, 0, wiring_.mask);
    modify32(io_, reset, wiring_.mask, 0);
    if (family_ == Family::kF746) {
      io_.write32(wiring_.base + spi::kCr2, spi::kCr2Ds8BitF7 | spi::kCr2FrxthF7);
    }
    control_ = 0;
  }

  std::uint32_t set_clock(std::uint32_t max_hz) {
    std::uint32_t br = 0;
    while (br < kSlowest && bus_hz_ >> (br + 1) > max_hz) ++br;
    const std::uint32_t control = kControl | br << spi::kCr1BrShift;
    if (control != control_) {
      io_.write32(wiring_.base + spi::kCr1, control);  // BR may change only while SPE is 0
      io_.write32(wiring_.base + spi::kCr1, control | spi::kCr1Spe);
      control_ = control;
    }
    return bus_hz_ >> (br + 1);
  }

  bool exchange_byte(std::uint8_t out, std::uint8_t& in) {
    if (!wait_for(spi::kSrTxe, spi::kSrTxe)) return false;
    io_.write8(wiring_.base + spi::kDr, out);
    if (!wait_for(spi::kSrRxne, spi::kSrRxne)) return false;
    in = io_.read8(wiring_.base + spi::kDr);
    return true;
  }
  bool wait_for(std::uint32_t mask, std::uint32_t value) {
    for (bool late = false;;) {
      const std::uint32_t flags = status();
      if ((flags & kErrors) != 0) return false;
      if ((flags & mask) == value) return true;
      if (late) return false;
      late = timer_.now_us() >= deadline_us_;  // polls once more: an interrupt may have delayed us
    }
  }

  [[no_unique_address]] Access io_;
  Gpio<Access> gpio_;
  Family family_;
  SpiWiring wiring_;
  Timer& timer_;
  SpiErrors errors_;
  std::uint64_t deadline_us_ = 0;
  std::uint32_t bus_hz_ = 0;
  std::uint32_t control_ = 0;  ///< CR1 without SPE; 0: not set
};

}  // namespace verp::hal::stm32
