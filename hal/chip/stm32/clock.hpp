#pragma once
#include <cstdint>

#include "hal/chip/stm32/clock_gate.hpp"
#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/flash.hpp"
#include "hal/chip/stm32/registers/memory_map.hpp"
#include "hal/chip/stm32/registers/pwr.hpp"
#include "hal/chip/stm32/registers/rcc.hpp"

/// Crystal, PLL, overdrive, bus clocks, flash wait states. Every wait ends. If the crystal or the
/// PLL on it fails, the PLL runs on the internal oscillator at the same speed. If that or the
/// needed overdrive also fails, the processor runs on the slow internal oscillator itself.
namespace verp::hal::stm32 {

enum class ClockSource : std::uint8_t {
  kCrystal = 0,
  kInternalPll = 1,  ///< within 1 % (DS8626, HSI accuracy): for USART, not CAN
  kInternal = 2,     ///< HSI, 16 MHz
  kAbsent = 3,       ///< no clock controller answers: an emulator
};

struct ClockPlan {
  std::uint32_t crystal_hz = 0;
  bool external = false;        ///< HSE is a clock signal, not a crystal
  std::uint32_t vco_hz = 0;     ///< twice SYSCLK
  std::uint32_t sysclk_hz = 0;  ///< APB1 runs at a quarter, APB2 at half
};

struct Clocks {
  ClockSource source = ClockSource::kAbsent;
  std::uint32_t sysclk_hz = 0;
  std::uint32_t apb1_hz = 0;
  std::uint32_t apb2_hz = 0;
  std::uint32_t apb1_timer_hz = 0;  ///< twice the bus clock where that is divided

  /// A CAN bit of 1 us does not tolerate an error of 1 %.
  bool good_enough_for_can() const { return source == ClockSource::kCrystal; }
};

template <Io Access>
class ClockTree {
 public:
  ClockTree(Family family, const ClockPlan& plan, Access io = {})
      : io_(io), family_(family), plan_(plan) {}

  /// Call once, right after a reset. Returns the clocks in use.
  Clocks start() {
    if (!is_set(rcc::kCr, rcc::kCrHsirdy)) return {};
    prepare_flash();
    if (start_crystal() && start_pll(plan_.crystal_hz, rcc::kPllcfgrSrcHse)) {
      watch_crystal();
      return divided(ClockSource::kCrystal);
    }
    stop_pll_and_crystal();
    if (start_pll(kHsi_hz, 0)) return divided(ClockSource::kInternalPll);
    stop_pll_and_crystal();
    return {ClockSource::kInternal, kHsi_hz, kHsi_hz, kHsi_hz, kHsi_hz};
  }

 private:
  // A poll takes about 10 cycles of HSI (16 MHz). Crystal: 2 ms typical, some ten times that. PLL:
  // 300 us (DS8626). Overdrive: 100 us (DS10916, over-drive switching characteristics). Margin:
  // about ten.
  static constexpr std::uint32_t kCrystalPolls = 200'000;
  static constexpr std::uint32_t kLockPolls = 5'000;
  static constexpr std::uint32_t kOverdrivePolls = 2'000;
  static constexpr std::uint32_t kSwitchPolls = 1'000;

  std::uint32_t at(std::uint32_t offset) const { return base::kRcc + offset; }
  bool is_set(std::uint32_t offset, std::uint32_t mask) {
    return (io_.read32(at(offset)) & mask) == mask;
  }
  bool wait_for(std::uint32_t offset, std::uint32_t mask, std::uint32_t value,
                std::uint32_t polls) {
    for (; polls > 0; --polls) {
      if ((io_.read32(at(offset)) & mask) == value) return true;
    }
    return false;
  }

  bool start_crystal() {
    // HSEBYP may change only while HSE is off.
    modify32(io_, at(rcc::kCr), rcc::kCrHseon, 0);
    modify32(io_, at(rcc::kCr), rcc::kCrHsebyp, plan_.external ? rcc::kCrHsebyp : 0);
    modify32(io_, at(rcc::kCr), 0, rcc::kCrHseon);
    return wait_for(rcc::kCr, rcc::kCrHserdy, rcc::kCrHserdy, kCrystalPolls);
  }

  bool start_pll(std::uint32_t source_hz, std::uint32_t source) {
    modify32(io_, at(rcc::kCr), rcc::kCrPllon, 0);
    if (!wait_for(rcc::kCr, rcc::kCrPllrdy, 0, kLockPolls)) return false;
    const std::uint32_t m = source_hz / kVcoIn_hz;
    const std::uint32_t n = plan_.vco_hz / kVcoIn_hz;
    const std::uint32_t q = (plan_.vco_hz + kUsb_hz - 1) / kUsb_hz;  // at most 48 MHz
    modify32(
        io_, at(rcc::kPllcfgr),
        rcc::kPllcfgrM | rcc::kPllcfgrN | rcc::kPllcfgrP | rcc::kPllcfgrSrcHse | rcc::kPllcfgrQ,
        m | n << rcc::kPllcfgrNShift | source | q << rcc::kPllcfgrQShift);
    modify32(io_, at(rcc::kCr), 0, rcc::kCrPllon);
    return overdrive() && wait_for(rcc::kCr, rcc::kCrPllrdy, rcc::kCrPllrdy, kLockPolls) &&
           set_wait_states() && switch_to(rcc::kClockPll);
  }

  // Overdrive must be entered in this order while the PLL settles (RM0385 4.1.4, RM0390 5.1.4). A
  // reset sets the regulator's highest scale.
  bool overdrive() {
    if (plan_.sysclk_hz <= limits(family_).sysclk_max_hz) return true;
    enable_clock(io_, rcc::kApb1enr, rcc::kApb1Pwr);
    return raise(pwr::kCrOden, pwr::kCsrOdrdy) && raise(pwr::kCrOdswen, pwr::kCsrOdswrdy);
  }
  bool raise(std::uint32_t enable, std::uint32_t ready) {
    modify32(io_, base::kPwr + pwr::kCr, 0, enable);
    for (std::uint32_t poll = 0; poll < kOverdrivePolls; ++poll) {
      if ((io_.read32(base::kPwr + pwr::kCsr) & ready) != 0) return true;
    }
    return false;
  }

  // Bus dividers come first: no bus ever runs too fast.
  bool switch_to(std::uint32_t clock) {
    const std::uint32_t dividers = clock == rcc::kClockPll ? rcc::kPpre4 << rcc::kCfgrPpre1Shift |
                                                                 rcc::kPpre2 << rcc::kCfgrPpre2Shift
                                                           : 0;
    if (clock == rcc::kClockPll) {
      modify32(io_, at(rcc::kCfgr), rcc::kCfgrHpre | rcc::kCfgrPpre1 | rcc::kCfgrPpre2, dividers);
    }
    modify32(io_, at(rcc::kCfgr), rcc::kCfgrSw, clock);
    return wait_for(rcc::kCfgr, rcc::kCfgrSws, clock << rcc::kCfgrSwsShift, kSwitchPolls);
  }

  void stop_pll_and_crystal() {
    switch_to(rcc::kClockHsi);
    modify32(io_, at(rcc::kCfgr), rcc::kCfgrHpre | rcc::kCfgrPpre1 | rcc::kCfgrPpre2, 0);
    modify32(io_, at(rcc::kCr), rcc::kCrPllon | rcc::kCrHseon, 0);
  }

  // A crystal that fails later raises the NMI: the fault handler and a reset.
  void watch_crystal() { modify32(io_, at(rcc::kCr), 0, rcc::kCrCsson); }

  // F4: enables the flash caches. F7: its prefetch and ART serve a bus that we don't use.
  void prepare_flash() {
    if (family_ == Family::kF746) return;
    modify32(io_, base::kFlash + flash::kAcr, 0,
             flash::kAcrPrften | flash::kAcrIcenF4 | flash::kAcrDcenF4);
  }

  bool set_wait_states() {
    const Limits& limit = limits(family_);
    const std::uint32_t mask =
        family_ == Family::kF405 ? flash::kAcrLatencyF405 : flash::kAcrLatency;
    const std::uint32_t states =
        (plan_.sysclk_hz + limit.hz_per_wait_state - 1) / limit.hz_per_wait_state - 1;
    modify32(io_, base::kFlash + flash::kAcr, mask, states);
    return (io_.read32(base::kFlash + flash::kAcr) & mask) == states;
  }

  Clocks divided(ClockSource source) const {
    return {source, plan_.sysclk_hz, plan_.sysclk_hz / 4, plan_.sysclk_hz / 2, plan_.sysclk_hz / 2};
  }

  static constexpr std::uint32_t kVcoIn_hz = 1'000'000;  ///< RM0090 7.3.2: 1 to 2 MHz
  static constexpr std::uint32_t kUsb_hz = 48'000'000;

  [[no_unique_address]] Access io_;
  Family family_;
  ClockPlan plan_;
};

/// True if the plan keeps the family's limits, overdrive included, and divides evenly.
constexpr bool is_possible(const ClockPlan& plan, Family family) {
  const Limits& limit = limits(family);
  const std::uint32_t n = plan.vco_hz / 1'000'000;
  return plan.crystal_hz >= 2'000'000 && plan.crystal_hz <= 63'000'000 &&
         plan.crystal_hz % 1'000'000 == 0 && plan.vco_hz % 1'000'000 == 0 && n >= limit.n_min &&
         n <= limit.n_max && plan.vco_hz >= limit.vco_min_hz && plan.vco_hz <= limit.vco_max_hz &&
         plan.vco_hz == 2 * plan.sysclk_hz && plan.sysclk_hz <= limit.sysclk_overdrive_max_hz &&
         plan.sysclk_hz / 4 <= limit.apb1_max_hz && plan.sysclk_hz / 2 <= limit.apb2_max_hz;
}

}  // namespace verp::hal::stm32
