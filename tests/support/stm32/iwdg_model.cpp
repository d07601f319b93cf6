#include "tests/support/stm32/iwdg_model.hpp"

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/registers/iwdg_table.hpp"

namespace verp::hal::stm32::model {

using namespace iwdg;

namespace {

/// RM0090 21.4.4: up to 5 cycles of the RC oscillator, in practice of LSI / 4.
constexpr std::uint32_t kUpdateCycles = 5 * 4;

}  // namespace

IwdgModel::IwdgModel(Machine& machine)
    : Bank(machine, "IWDG", base::kIwdg,
           machine.family() == Family::kF746 ? iwdg::kTableF7 : iwdg::kTable, {}) {}

void IwdgModel::reset() {
  Bank::reset();
  unlocked_ = started_ = false;
  bites_at_ = kNever;
  prescaler_done_ = reload_done_ = window_done_ = 0;
}

Time IwdgModel::step() const {
  const std::uint32_t pr = reg(kPr) > kPrMax ? kPrMax : reg(kPr);
  return duration(std::uint64_t{4} << pr, lsi_hz);
}

void IwdgModel::reload() {
  bites_at_ = machine().now() + step() * (reg(kRlr) + 1);
}

Time IwdgModel::next() const {
  return started_ ? bites_at_ : kNever;
}

void IwdgModel::run() {
  if (next() > machine().now()) return;
  machine().reset(ResetCause::kIwdg);
}

void IwdgModel::before_read(std::uint32_t offset) {
  if (offset != kSr) return;
  const Time now = machine().now();
  reg(kSr) = (busy_stuck || prescaler_done_ > now ? kSrPvu : 0) |
             (busy_stuck || reload_done_ > now ? kSrRvu : 0);
  if (machine().family() == Family::kF746 && window_done_ > now) reg(kSr) |= kSrWvu;
}

bool IwdgModel::may_write(std::uint32_t offset, std::uint32_t) {
  if (offset == kKr) return true;
  if (!unlocked_) {
    violate("write without the key 0x5555");
    return false;
  }
  const Time done = offset == kPr ? prescaler_done_ : offset == kRlr ? reload_done_ : window_done_;
  if (busy_stuck || done > machine().now()) {
    violate("write while the last one is still on its way (PVU, RVU)");
    return false;
  }
  return true;
}

void IwdgModel::on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t) {
  const Time done = machine().now() + duration(kUpdateCycles, lsi_hz);
  if (offset == kPr) prescaler_done_ = done;
  if (offset == kRlr) reload_done_ = done;
  if (offset == kWinr) {
    window_done_ = done;
    violate("the window is not modelled");
  }
  if (offset != kKr) return;
  unlocked_ = raw == kKeyUnlock;
  if (raw == kKeyStart) {
    started_ = true;
    reload();
  } else if (raw == kKeyReload) {
    if (started_) reload();
  } else if (raw != kKeyUnlock) {
    violate("unknown key");
  }
}

}  // namespace verp::hal::stm32::model
