#include "tests/support/stm32/spi_model.hpp"

#include <algorithm>
#include <string>

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/rcc_model.hpp"
#include "tests/support/stm32/registers/spi_table.hpp"

namespace verp::hal::stm32::model {

using namespace spi;

SpiModel::SpiModel(Machine& machine, unsigned number, std::uint32_t base, Gate gate, unsigned irq)
    : Bank(machine, "SPI" + std::to_string(number), base, spi::table(machine.family()), gate),
      irq_(irq),
      v2_(machine.family() == Family::kF746) {}

void SpiModel::reset() {
  Bank::reset();
  tx_.clear();
  rx_.clear();
  dr_ = 0;
  shifting_ = overrun_seen_data_ = false;
  done_at_ = kNever;
}

void SpiModel::attach(SpiDevice& device, GpioModel& port, unsigned select_pin) {
  devices_.push_back({&device, &port, select_pin});
  port.on_change([this, &device, select_pin](unsigned pin, bool level) {
    if (pin != select_pin) return;
    if (level && shifting_) violate("chip select released while a byte is under way");
    device.select(!level, machine().now());
  });
}

std::uint32_t SpiModel::clock_hz() const {
  return machine().rcc().bus_hz(base()) / (2u << ((reg(kCr1) & kCr1Br) >> kCr1BrShift));
}

void SpiModel::update_flags() {
  const std::size_t wanted = v2_ && !has(kCr2, kCr2FrxthF7) ? 2 : 1;
  clear(kSr, kSrRxne | kSrTxe | kSrBsy);
  if (rx_.size() >= wanted) set(kSr, kSrRxne);
  if (tx_.size() <= depth() / 2 && tx_.size() < depth()) set(kSr, kSrTxe);
  if (shifting_ || !tx_.empty()) set(kSr, kSrBsy);
  if (!v2_) return;
  clear(kSr, kSrFrlvlF7 | kSrFtlvlF7);
  const auto level = [](std::size_t bytes) {
    return static_cast<std::uint32_t>(std::min<std::size_t>(bytes, 3));
  };
  set(kSr, level(rx_.size()) << 9 | level(tx_.size()) << 11);
}

void SpiModel::load() {
  if (!shifting_ && !tx_.empty() && enabled() && has(kCr1, kCr1Mstr)) {
    shift_ = tx_.front();
    tx_.pop_front();
    shifting_ = true;
    done_at_ = machine().now() + duration(8, clock_hz());
  }
  update_flags();
  machine().touch();
}

std::uint8_t SpiModel::exchange(std::uint8_t out) {
  ++exchanged_;
  for (const Pin& pin : pins_) {
    if (pin.port->function(pin.pin) != pin.function) return 0xFF;
  }
  const unsigned mode = (has(kCr1, kCr1Cpol) ? 2u : 0u) + (has(kCr1, kCr1Cpha) ? 1u : 0u);
  std::uint8_t in = 0xFF;
  unsigned selected = 0;
  for (const Attached& attached : devices_) {
    if (attached.port->level(attached.pin)) continue;
    ++selected;
    if (!attached.device->takes_mode(mode)) violate("clock mode that the device doesn't take");
    if (clock_hz() > attached.device->max_hz()) {
      violate(std::to_string(clock_hz()) + " Hz, the device takes " +
              std::to_string(attached.device->max_hz()));
    }
    in = static_cast<std::uint8_t>(in & attached.device->exchange(out, machine().now()));
  }
  if (selected > 1) violate("more than one device selected");
  if (miso_stuck_high) return 0xFF;
  return miso_stuck_low ? 0x00 : in;
}

void SpiModel::run() {
  if (next() > machine().now()) return;
  shifting_ = false;
  done_at_ = kNever;
  const std::uint8_t in = exchange(shift_);
  if (rx_.size() < depth() && !overrun_next) {
    rx_.push_back(in);
  } else {
    overrun_next = false;
    set(kSr, kSrOvr);
    overrun_seen_data_ = false;
  }
  load();
}

void SpiModel::data_written(std::uint32_t raw) {
  const unsigned bytes = v2_ && access_width() > 1 ? 2 : 1;
  if (!enabled()) violate("DR written while SPE is 0");
  if (v2_ && (reg(kCr2) & kCr2DsF7) != kCr2Ds8BitF7) violate("only 8-bit frames are modelled");
  if (!v2_ && has(kCr1, kCr1DffF4)) violate("only 8-bit frames are modelled");
  for (unsigned i = 0; i < bytes; ++i) {
    if (tx_.size() >= depth()) {
      violate("DR written while TXE is 0: a byte is lost");
      tx_.pop_back();
    }
    tx_.push_back(static_cast<std::uint8_t>(raw >> (8 * i)));
    load();
  }
}

void SpiModel::control_written(std::uint32_t old) {
  const std::uint32_t fixed =
      kCr1Cpha | kCr1Cpol | kCr1Br | kCr1Mstr | kCr1Lsbfirst | bit(11) | kCr1Bidimode | kCr1Rxonly;
  if (enabled() && (old & kCr1Spe) != 0 && ((old ^ reg(kCr1)) & fixed) != 0) {
    violate("clock or frame changed while SPE is set");
  }
  if (!enabled() && (old & kCr1Spe) != 0 && (shifting_ || !tx_.empty())) {
    violate("SPE cleared while BSY");
    tx_.clear();
    shifting_ = false;
  }
  if (has(kCr1, kCr1Bidimode | kCr1Rxonly | kCr1Lsbfirst | kCr1Crcen)) {
    violate("only full-duplex frames, MSB first and without CRC, are modelled");
  }
  const bool fault =
      has(kCr1, kCr1Mstr) && !has(kCr2, kCr2Ssoe) && has(kCr1, kCr1Ssm) && !has(kCr1, kCr1Ssi);
  if (fault) {  // internal select low: another master
    set(kSr, kSrModf);
    clear(kCr1, kCr1Mstr | kCr1Spe);
  }
  load();
}

bool SpiModel::may_write(std::uint32_t offset, std::uint32_t raw) {
  if (offset == kCr2 && v2_ && enabled() && ((raw ^ reg(kCr2)) & kCr2DsF7) != 0) {
    violate("DS changed while SPE is set");
  }
  return true;
}

void SpiModel::on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) {
  if (offset == kDr) data_written(raw);
  if (offset == kCr1) {
    clear(kSr, kSrModf);
    control_written(old);
  }
  if (offset == kCr2) load();
}

void SpiModel::before_read(std::uint32_t offset) {
  if (offset != kDr) return;
  const std::size_t wanted = v2_ && access_width() > 1 ? 2 : 1;
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < wanted && i < rx_.size(); ++i) {
    value |= static_cast<std::uint32_t>(rx_[i]) << (8 * i);
  }
  if (!rx_.empty()) dr_ = value;
  reg(kDr) = dr_;
}

void SpiModel::after_read(std::uint32_t offset) {
  if (offset == kDr) {
    const std::size_t wanted = v2_ && access_width() > 1 ? 2 : 1;
    for (std::size_t i = 0; i < wanted && !rx_.empty(); ++i) rx_.pop_front();
    overrun_seen_data_ = true;
    load();
  }
  if (offset == kSr && has(kSr, kSrOvr) && overrun_seen_data_) {
    clear(kSr, kSrOvr);  // DR read, then SR
    machine().touch();
  }
}

bool SpiModel::narrow_ok(std::uint32_t offset, unsigned) const {
  return offset == kDr;
}

bool SpiModel::dma_request(bool transmit) const {
  if (transmit) return has(kCr2, kCr2Txdmaen) && enabled() && has(kSr, kSrTxe);
  return has(kCr2, kCr2Rxdmaen) && has(kSr, kSrRxne);
}

bool SpiModel::interrupt(unsigned irq) const {
  if (irq != irq_) return false;
  return (has(kCr2, kCr2Rxneie) && has(kSr, kSrRxne)) ||
         (has(kCr2, kCr2Txeie) && has(kSr, kSrTxe)) ||
         (has(kCr2, kCr2Errie) && has(kSr, kSrOvr | kSrModf | kSrCrcerr | kSrFre));
}

}  // namespace verp::hal::stm32::model
