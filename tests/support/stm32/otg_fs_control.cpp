#include <string>

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/otg_fs_model.hpp"
#include "tests/support/stm32/rcc_model.hpp"
#include "tests/support/stm32/registers/otg_fs_table.hpp"

namespace verp::hal::stm32::model {

using namespace otg_fs;

void OtgFsModel::reset_written(std::uint32_t raw, std::uint32_t old) {
  constexpr std::uint32_t kFlushes = kGrstctlRxfflsh | kGrstctlTxfflsh;
  if ((raw & (kGrstctlHsrst | kGrstctlFcrst)) != 0) violate("HSRST and FCRST are not modelled");
  if ((raw & (kFlushes | kGrstctlCsrst)) != 0 && ahb_busy)
    violate("GRSTCTL used while AHBIDL is 0");
  if ((raw & kGrstctlCsrst) != 0 && (old & kGrstctlCsrst) == 0) {
    reset_core();
    set(kGrstctl, kGrstctlCsrst);
    if (!core_reset_stuck) later(core_reset_time, [this] { clear(kGrstctl, kGrstctlCsrst); });
    return;
  }
  if ((raw & kFlushes) == 0) return;
  if ((old & kFlushes) != 0) {
    violate("a flush begun while another is under way");
    return;
  }
  if ((raw & kGrstctlRxfflsh) != 0) received_.clear();
  if ((raw & kGrstctlTxfflsh) != 0) flush_transmit((raw & kGrstctlTxfnum) >> kGrstctlTxfnumShift);
  if (!flush_stuck) later(flush_time, [this] { clear(kGrstctl, kFlushes); });
}

void OtgFsModel::flush_transmit(std::uint32_t number) {
  const bool all = number == 0x10;
  if (!all && number >= endpoints_) violate("flush of no FIFO");
  for (unsigned e = 0; e < endpoints_; ++e) {
    if (!all && number != e) continue;
    const bool nak = has(diepctl(e), kEpctlNaksts) || has(kDctl, kDctlGinsts);
    if (has(diepctl(e), kEpctlEpena) && !nak) violate(named(true, e) + " flushed without NAK");
    in_[e].fifo.clear();
  }
}

void OtgFsModel::device_control_written(std::uint32_t raw, std::uint32_t old) {
  if ((raw & kDctlTctl) != 0) violate("test modes are not modelled");
  if ((raw & kDctlSginak) != 0) {
    set(kDctl, kDctlGinsts);
    set(kGintsts, kGintGinakeff);
  }
  if ((raw & kDctlCginak) != 0) {
    clear(kDctl, kDctlGinsts);
    clear(kGintsts, kGintGinakeff);
  }
  if ((raw & kDctlSgonak) != 0 && !global_out_nak_) {
    global_out_nak_ = true;
    receive(kPacketGlobalOutNak, 0, false, nullptr, 0);
  } else if ((raw & kDctlSgonak) != 0) {
    violate("SGONAK written while it is in effect");
  }
  if ((raw & kDctlCgonak) != 0) {
    global_out_nak_ = false;
    clear(kDctl, kDctlGonsts);
    clear(kGintsts, kGintGonakeff);
  }
  const std::uint32_t wakeup = (raw ^ old) & kDctlRwusig;
  if (wakeup != 0 && has(kDctl, kDctlRwusig)) {
    wakeup_from_ = machine().now();
    if (!has(kDsts, kDstsSuspsts)) violate("RWUSIG set while the bus isn't suspended");
  } else if (wakeup != 0) {
    const Time lasted = machine().now() - wakeup_from_;
    if (lasted < ms(1) || lasted > ms(15)) violate("RWUSIG not held for 1 to 15 ms");
  }
}

void OtgFsModel::power_written() {
  clear(kPcgcctl, kPcgcctlPhysusp);
  if (has(kPcgcctl, kPcgcctlStppclk)) set(kPcgcctl, kPcgcctlPhysusp);
  if (has(kPcgcctl, kPcgcctlStppclk | kPcgcctlGatehclk) && !has(kDsts, kDstsSuspsts)) {
    violate("PCGCCTL stops the clock while the bus isn't suspended");
  }
}

void OtgFsModel::check_clocks() {
  const std::uint32_t hz = machine().rcc().usb_hz();
  if (!usb_clock_ok(hz)) {
    violate("its clock is " + std::to_string(hz) + " Hz, not 48 MHz");
  }
  const bool crystal = (machine().rcc().peek(rcc::kPllcfgr) & rcc::kPllcfgrSrcHse) != 0;
  if (usb_clock_ok(hz) && !crystal) violate("its clock comes from the internal oscillator");
  if (turnaround(machine().rcc().hclk_hz()) == 0) violate("the AHB is slower than 14.2 MHz");
}

}  // namespace verp::hal::stm32::model
