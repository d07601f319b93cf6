#include "tests/support/stm32/rcc_model.hpp"

#include <algorithm>

#include "tests/support/stm32/flash_model.hpp"
#include "tests/support/stm32/registers/pwr_table.hpp"

namespace verp::hal::stm32::model {

using namespace rcc;

namespace {

std::uint32_t field(std::uint32_t value, std::uint32_t mask) {
  return (value & mask) / (mask & (~mask + 1));
}
std::uint32_t ahb_divider(std::uint32_t hpre) {
  constexpr std::uint32_t kDividers[] = {2, 4, 8, 16, 64, 128, 256, 512};
  return hpre < 8 ? 1 : kDividers[hpre - 8];
}
std::uint32_t apb_divider(std::uint32_t ppre) {
  return ppre < 4 ? 1 : 2u << (ppre - 4);
}

}  // namespace

RccModel::RccModel(Machine& machine)
    : Bank(machine, "RCC", base::kRcc, rcc::table(machine.family()), {}) {}

void RccModel::reset() {
  const std::uint32_t backup = reg(kBdcr);
  const std::uint32_t flags = reg(kCsr) & bits(25, 7);
  Bank::reset();
  reg(kBdcr) = backup;
  reg(kCsr) = flags;
  hse_at_ = hsi_at_ = pll_at_ = lsi_at_ = switch_at_ = kNever;
  fresh_bits_ = 0;
}

void RccModel::flag_reset(ResetCause cause) {
  std::uint32_t flags = kCsrPinrstf;  // internal resets pull the pin
  if (cause == ResetCause::kPowerOn) flags |= kCsrPorrstf | kCsrBorrstf;
  if (cause == ResetCause::kBrownOut) flags |= kCsrBorrstf;
  if (cause == ResetCause::kSoftware) flags |= kCsrSftrstf;
  if (cause == ResetCause::kIwdg) flags |= kCsrIwdgrstf;
  if (cause == ResetCause::kWwdg) flags |= kCsrWwdgrstf;
  if (cause == ResetCause::kLowPower) flags |= kCsrLpwrrstf;
  if (cause == ResetCause::kPowerOn) clear(kCsr, bits(25, 7));
  set(kCsr, flags);
}

std::uint32_t RccModel::source_hz(std::uint32_t source) const {
  if (source == kClockHse) return machine().options().hse_hz;
  return source == kClockPll ? pll_hz() : kHsi_hz;
}
bool RccModel::ready(std::uint32_t source) const {
  const std::uint32_t flag = source == kClockHse   ? kCrHserdy
                             : source == kClockPll ? kCrPllrdy
                                                   : kCrHsirdy;
  return has(kCr, flag);
}
std::uint32_t RccModel::pll_input_hz() const {
  const std::uint32_t m = field(reg(kPllcfgr), kPllcfgrM);
  const bool hse = has(kPllcfgr, kPllcfgrSrcHse);
  return (hse ? machine().options().hse_hz : kHsi_hz) / std::max<std::uint32_t>(1u, m);
}
std::uint32_t RccModel::pll_hz() const {
  const std::uint64_t vco = std::uint64_t{pll_input_hz()} * field(reg(kPllcfgr), kPllcfgrN);
  return static_cast<std::uint32_t>(vco / (2 * (field(reg(kPllcfgr), kPllcfgrP) + 1)));
}
std::uint32_t RccModel::usb_hz() const {
  const std::uint32_t select = machine().family() == Family::kF405   ? 0
                               : machine().family() == Family::kF446 ? kDckcfgr2F446
                                                                     : kDckcfgr2F746;
  if (select != 0 && has(select, kDckcfgr2Ck48msel)) return 0;
  if (!has(kCr, kCrPllrdy)) return 0;
  const std::uint64_t vco = std::uint64_t{pll_input_hz()} * field(reg(kPllcfgr), kPllcfgrN);
  return static_cast<std::uint32_t>(vco /
                                    std::max<std::uint32_t>(1u, field(reg(kPllcfgr), kPllcfgrQ)));
}
std::uint32_t RccModel::sysclk_hz() const {
  return source_hz(field(reg(kCfgr), kCfgrSws));
}
std::uint32_t RccModel::hclk_hz() const {
  return sysclk_hz() / ahb_divider(field(reg(kCfgr), kCfgrHpre));
}
std::uint32_t RccModel::apb1_hz() const {
  return hclk_hz() / apb_divider(field(reg(kCfgr), kCfgrPpre1));
}
std::uint32_t RccModel::apb2_hz() const {
  return hclk_hz() / apb_divider(field(reg(kCfgr), kCfgrPpre2));
}
std::uint32_t RccModel::bus_hz(std::uint32_t base) const {
  return base < 0x40010000 ? apb1_hz() : apb2_hz();
}
std::uint32_t RccModel::timer_hz(std::uint32_t base) const {
  const bool first = base < 0x40010000;
  const std::uint32_t divider = apb_divider(field(reg(kCfgr), first ? kCfgrPpre1 : kCfgrPpre2));
  const bool times4 =
      machine().family() != Family::kF405 && has(kDckcfgr, kDckcfgrTimpre) && divider >= 4;
  const std::uint32_t bus = bus_hz(base);
  return divider == 1 ? bus : (times4 ? 4 * bus : 2 * bus);
}

Time RccModel::next() const {
  return std::min({hse_at_, hsi_at_, pll_at_, lsi_at_, switch_at_});
}

void RccModel::run() {
  const Time now = machine().now();
  const auto due = [now](Time& at) {
    if (at > now) return false;
    at = kNever;
    return true;
  };
  if (due(hse_at_)) set(kCr, kCrHserdy);
  if (due(hsi_at_)) set(kCr, kCrHsirdy);
  if (due(pll_at_)) set(kCr, kCrPllrdy);
  if (due(lsi_at_)) set(kCsr, kCsrLsirdy);
  if (switch_at_ <= now && ready(field(reg(kCfgr), kCfgrSw))) {
    switch_at_ = kNever;
    machine().clocks_change();
    clear(kCfgr, kCfgrSws);
    set(kCfgr, field(reg(kCfgr), kCfgrSw) << kCfgrSwsShift);
    check_limits();
  } else if (switch_at_ <= now) {
    switch_at_ = now + switch_time;
  }
}

void RccModel::oscillator(std::uint32_t old, std::uint32_t on, std::uint32_t ready, Time& at,
                          Time takes) {
  if (!has(kCr, on)) {
    clear(kCr, ready);
    at = kNever;
  } else if ((old & on) == 0) {
    at = takes == kNever ? kNever : machine().now() + takes;
  }
}

void RccModel::control_written(std::uint32_t old) {
  const std::uint32_t used = field(reg(kCfgr), kCfgrSws);
  const bool pll_from_hse = has(kPllcfgr, kPllcfgrSrcHse);
  // The system clock's oscillators stay on.
  std::uint32_t kept = used == kClockHsi ? kCrHsion : used == kClockHse ? kCrHseon : kCrPllon;
  if (used == kClockPll) kept |= pll_from_hse ? kCrHseon : kCrHsion;
  if ((reg(kCr) & kept) != kept) {
    violate("switches off the oscillator of the system clock");
    set(kCr, kept);
  }
  if (((old ^ reg(kCr)) & kCrHsebyp) != 0 && (old & kCrHseon) != 0) {
    violate("changes HSEBYP while the HSE is on");
  }
  oscillator(old, kCrHsion, kCrHsirdy, hsi_at_, us(2));
  oscillator(old, kCrHseon, kCrHserdy, hse_at_, hse_start);
  const bool starts = has(kCr, kCrPllon) && (old & kCrPllon) == 0;
  const bool source = has(kCr, pll_from_hse ? kCrHserdy : kCrHsirdy);
  if (starts && !source) violate("PLL switched on before its source is ready");
  if (starts) check_pll();
  oscillator(old, kCrPllon, kCrPllrdy, pll_at_, source ? pll_lock : kNever);
}

void RccModel::check_pll() {
  const Limits& chip = limits(machine().family());
  const std::uint32_t n = field(reg(kPllcfgr), kPllcfgrN);
  const std::uint64_t vco = std::uint64_t{pll_input_hz()} * n;
  if (field(reg(kPllcfgr), kPllcfgrM) < 2) violate("PLLM below 2");
  if (n < chip.n_min || n > chip.n_max) violate("PLLN out of range");
  if (field(reg(kPllcfgr), kPllcfgrQ) < 2) violate("PLLQ below 2");
  if (pll_input_hz() < chip.vco_in_min_hz || pll_input_hz() > chip.vco_in_max_hz) {
    violate("PLL input of " + std::to_string(pll_input_hz()) + " Hz");
  }
  if (vco < chip.vco_min_hz || vco > chip.vco_max_hz) {
    violate("VCO at " + std::to_string(vco) + " Hz");
  }
}

void RccModel::check_limits() {
  const Limits& chip = limits(machine().family());
  const std::uint32_t need = (hclk_hz() + chip.hz_per_wait_state - 1) / chip.hz_per_wait_state - 1;
  const std::uint32_t have = machine().flash().wait_states();
  if (have < need) {
    violate(std::to_string(have) + " wait states where " + std::to_string(hclk_hz()) + " Hz need " +
            std::to_string(need));
  }
  if (hclk_hz() > machine().pwr().hclk_max_hz()) violate("HCLK too high for the voltage scale");
  if (apb1_hz() > chip.apb1_max_hz) violate("APB1 at " + std::to_string(apb1_hz()) + " Hz");
  if (apb2_hz() > chip.apb2_max_hz) violate("APB2 at " + std::to_string(apb2_hz()) + " Hz");
}

bool RccModel::may_write(std::uint32_t offset, std::uint32_t raw) {
  if (offset == kBdcr && raw != reg(kBdcr) && !machine().pwr().backup_unlocked()) {
    violate("write to BDCR without PWR_CR.DBP");
    return false;
  }
  if (offset == kPllcfgr && has(kCr, kCrPllon)) {
    violate("write to PLLCFGR while the PLL is on");
    return false;
  }
  if (offset == kCfgr || offset == kDckcfgr) machine().clocks_change();
  return true;
}

void RccModel::on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) {
  if (offset == kCr) control_written(old);
  if (offset == kCfgr) {
    const std::uint32_t wanted = field(reg(kCfgr), kCfgrSw);
    if (wanted != field(reg(kCfgr), kCfgrSws) && !sws_stuck) {
      if (wanted > kClockPll || !ready(wanted)) violate("SW set to a clock that is not ready");
      switch_at_ = machine().now() + switch_time;
    }
    check_limits();
  }
  if (offset == kCsr) {
    if ((raw & kCsrRmvf) != 0) clear(kCsr, bits(25, 7));
    if (!has(kCsr, kCsrLsion)) clear(kCsr, kCsrLsirdy);
    if (has(kCsr, kCsrLsion) && (old & kCsrLsion) == 0) {
      lsi_at_ = lsi_start == kNever ? kNever : machine().now() + lsi_start;
    }
  }
  if (offset >= kAhb1rstr && offset <= kApb2rstr) machine().reset_banks(offset, raw);
  if (offset >= kAhb1enr && offset <= kApb2enr) {
    fresh_offset_ = offset;
    fresh_bits_ = reg(offset) & ~old;
  }
}

PwrModel::PwrModel(Machine& machine)
    : Bank(machine, "PWR", base::kPwr, pwr::table(machine.family()),
           {rcc::kApb1enr, rcc::kApb1Pwr, rcc::kApb1Pwr}) {
  set(pwr::kCsr, pwr::kCsrVosrdy);
}

void PwrModel::reset() {
  Bank::reset();
  set(pwr::kCsr, pwr::kCsrVosrdy);
  at_ = kNever;
}

bool PwrModel::overdrive() const {
  return has(pwr::kCsr, pwr::kCsrOdswrdy);
}

std::uint32_t PwrModel::hclk_max_hz() const {
  // RM0090 5.1.3 (F405: 144 and 168 MHz), RM0390 5.1.4, RM0385 4.1.4.
  const std::uint32_t scale = (reg(pwr::kCr) & pwr::kCrVos) >> pwr::kCrVosShift;
  const std::uint32_t over = overdrive() ? 1u : 0u;
  switch (machine().family()) {
    case Family::kF405:
      return scale == 1 ? 168000000 : 144000000;
    case Family::kF446: {
      constexpr std::uint32_t kMax[4][2] = {
          {0, 0}, {120000000, 120000000}, {144000000, 168000000}, {168000000, 180000000}};
      return kMax[scale][over];
    }
    case Family::kF746:
    default: {
      constexpr std::uint32_t kMax[4][2] = {
          {0, 0}, {144000000, 144000000}, {168000000, 180000000}, {180000000, 216000000}};
      return kMax[scale][over];
    }
  }
}

bool PwrModel::may_write(std::uint32_t offset, std::uint32_t raw) {
  if (offset != pwr::kCr || machine().family() == Family::kF405) return true;
  const bool scale_changes = ((raw ^ reg(pwr::kCr)) & pwr::kCrVos) != 0;
  if (scale_changes && (machine().rcc().peek(rcc::kCr) & rcc::kCrPllon) != 0) {
    violate("VOS changed while the PLL is on");
    return false;
  }
  return true;
}

void PwrModel::on_write(std::uint32_t offset, std::uint32_t, std::uint32_t old) {
  if (offset != pwr::kCr || machine().family() == Family::kF405) return;
  const std::uint32_t rises = reg(pwr::kCr) & ~old;
  if ((rises & pwr::kCrOdswen) != 0 && !has(pwr::kCsr, pwr::kCsrOdrdy)) {
    violate("ODSWEN set before ODRDY");
  }
  if (!has(pwr::kCr, pwr::kCrOden)) clear(pwr::kCsr, pwr::kCsrOdrdy);
  if (!has(pwr::kCr, pwr::kCrOdswen)) clear(pwr::kCsr, pwr::kCsrOdswrdy);
  if ((rises & (pwr::kCrOden | pwr::kCrOdswen)) != 0 && !overdrive_stuck) {
    at_ = machine().now() + overdrive_time;
  }
  machine().rcc().check_limits();
}

void PwrModel::run() {
  if (at_ > machine().now()) return;
  at_ = kNever;
  if (has(pwr::kCr, pwr::kCrOden)) set(pwr::kCsr, pwr::kCsrOdrdy);
  if (has(pwr::kCr, pwr::kCrOdswen)) set(pwr::kCsr, pwr::kCsrOdswrdy);
}

}  // namespace verp::hal::stm32::model
