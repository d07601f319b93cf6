#pragma once
#include <cstdint>

#include "hal/chip/stm32/clock_gate.hpp"
#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/gpio.hpp"
#include "hal/chip/stm32/registers/memory_map.hpp"
#include "hal/chip/stm32/registers/rcc.hpp"

/// Each function enables its port's clock.
namespace verp::hal::stm32 {

struct Pin {
  char port = 0;  ///< 'A' to 'K'; 0: no pin
  std::uint8_t number = 0;

  constexpr bool exists() const { return port != 0; }
};

template <Io Access>
class Gpio {
 public:
  explicit Gpio(Access io = {}) : io_(io) {}

  /// Hands the pin to a peripheral. A pull-up keeps an open receive line idle.
  void alternate(Pin pin, std::uint32_t function, std::uint32_t pull = gpio::kPullNone) {
    if (!pin.exists()) return;
    enable(pin);
    const std::uint32_t low = pin.number < 8 ? gpio::kAfrl : gpio::kAfrh;
    modify32(io_, at(pin, low), field(pin.number % 8u, 4, 0xF),
             field(pin.number % 8u, 4, function));
    set(pin, gpio::kOspeedr, gpio::kSpeedHigh);
    set(pin, gpio::kPupdr, pull);
    set(pin, gpio::kModer, gpio::kModeAlternate);
  }
  /// Drives the pin, at `high` from the start.
  void output(Pin pin, bool high) {
    if (!pin.exists()) return;
    enable(pin);
    write(pin, high);
    set(pin, gpio::kOspeedr, gpio::kSpeedMedium);
    set(pin, gpio::kModer, gpio::kModeOutput);
  }
  void input(Pin pin, std::uint32_t pull) {
    if (!pin.exists()) return;
    enable(pin);
    set(pin, gpio::kPupdr, pull);
    set(pin, gpio::kModer, gpio::kModeInput);
  }
  void analog(Pin pin) {
    if (!pin.exists()) return;
    enable(pin);
    set(pin, gpio::kPupdr, gpio::kPullNone);
    set(pin, gpio::kModer, gpio::kModeAnalog);
  }
  void write(Pin pin, bool high) {
    if (!pin.exists()) return;
    io_.write32(at(pin, gpio::kBsrr), 1u << (pin.number + (high ? 0u : 16u)));
  }
  bool read(Pin pin) {
    return pin.exists() && (io_.read32(at(pin, gpio::kIdr)) >> pin.number & 1u) != 0;
  }

 private:
  static constexpr std::uint32_t field(unsigned index, unsigned width, std::uint32_t value) {
    return value << (index * width);
  }
  static std::uint32_t at(Pin pin, std::uint32_t offset) { return base::gpio(pin.port) + offset; }
  void set(Pin pin, std::uint32_t offset, std::uint32_t value) {
    modify32(io_, at(pin, offset), field(pin.number, 2, 3), field(pin.number, 2, value));
  }
  void enable(Pin pin) {
    const auto port = static_cast<unsigned>(pin.port - 'A');
    enable_clock(io_, rcc::kAhb1enr, rcc::kAhb1GpioA << port);
  }

  [[no_unique_address]] Access io_;
};

}  // namespace verp::hal::stm32
