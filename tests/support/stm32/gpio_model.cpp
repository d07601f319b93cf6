#include "tests/support/stm32/gpio_model.hpp"

#include <string>

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/rcc_model.hpp"
#include "tests/support/stm32/registers/gpio_table.hpp"

namespace verp::hal::stm32::model {

using namespace gpio;

namespace {

Gate gate_of(char port) {
  const std::uint32_t mask = bit(static_cast<unsigned>(port - 'A'));
  return {rcc::kAhb1enr, mask, mask};
}

}  // namespace

GpioModel::GpioModel(Machine& machine, char port)
    : Bank(machine, std::string("GPIO") + port, base::gpio(port), gpio::kTable, gate_of(port)),
      port_(port) {
  for (Outside& outside : outside_) outside = Outside::kOpen;
  GpioModel::reset();
}

void GpioModel::reset() {
  Bank::reset();
  if (port_ == 'A') {
    reg(kModer) = kModerResetA;
    reg(kOspeedr) = kOspeedrResetA;
    reg(kPupdr) = kPupdrResetA;
  } else if (port_ == 'B') {
    reg(kModer) = kModerResetB;
    reg(kOspeedr) = kOspeedrResetB;
    reg(kPupdr) = kPupdrResetB;
  }
  watch();
}

std::uint32_t GpioModel::mode(unsigned pin) const {
  return reg(kModer) >> (2 * pin) & 3u;
}
bool GpioModel::open_drain(unsigned pin) const {
  return (reg(kOtyper) >> pin & 1u) != 0;
}
unsigned GpioModel::function(unsigned pin) const {
  if (mode(pin) != kModeAlternate) return 16;
  return reg(pin < 8 ? kAfrl : kAfrh) >> (4 * (pin % 8)) & 15u;
}

bool GpioModel::level(unsigned pin) const {
  const bool output = (reg(kOdr) >> pin & 1u) != 0;
  const bool drives = mode(pin) == kModeOutput && (!open_drain(pin) || !output);
  if (drives) return output;
  if (outside_[pin] != Outside::kOpen) return outside_[pin] == Outside::kHigh;
  return (reg(kPupdr) >> (2 * pin) & 3u) == kPullUp;
}

void GpioModel::drive(unsigned pin, Outside level) {
  outside_[pin] = level;
  watch();
  machine().touch();
}

void GpioModel::before_read(std::uint32_t offset) {
  if (offset != kIdr) return;
  std::uint32_t levels = 0;
  for (unsigned pin = 0; pin < 16; ++pin) {
    if (mode(pin) != kModeAnalog && level(pin)) levels |= bit(pin);
  }
  reg(kIdr) = levels;
}

void GpioModel::on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t) {
  if (offset == kBsrr) {
    clear(kOdr, raw >> 16);
    set(kOdr, raw & 0xFFFF);  // a set bit wins over its reset bit
  }
  if (offset == kLckr) violate("LCKR is not modelled");
  watch();
}

void GpioModel::watch() {
  for (unsigned pin = 0; pin < 16; ++pin) {
    const bool now = level(pin);
    if (now == ((seen_ >> pin & 1u) != 0)) continue;
    seen_ ^= bit(pin);
    for (const auto& watcher : watchers_) watcher(pin, now);
  }
}

}  // namespace verp::hal::stm32::model
