#include "tests/support/stm32/core_model.hpp"

#include "tests/support/stm32/machine.hpp"

namespace verp::hal::stm32::model {

using namespace cortex_m;

void CoreModel::reset() {
  words_.clear();
  for (std::uint32_t& word : enabled_) word = 0;
  for (std::uint32_t& word : pended_) word = 0;
  systick_from_ = systick_flagged_ = machine_.core_cycles();
}

std::uint32_t CoreModel::remembered(std::uint32_t address) const {
  const auto found = words_.find(address);
  return found == words_.end() ? 0 : found->second;
}

std::uint32_t CoreModel::systick_count() const {
  const std::uint64_t period = std::uint64_t{remembered(kSystRvr) & kSystMax} + 1;
  if ((remembered(kSystCsr) & kSystCsrEnable) == 0) return 0;
  const std::uint64_t gone = machine_.core_cycles() - systick_from_;
  return static_cast<std::uint32_t>(period - 1 - gone % period);
}

std::uint32_t CoreModel::read(std::uint32_t address) {
  const std::uint32_t word = (address & 0x7F) / 4;
  switch (address & ~0x7Fu) {
    case kNvicIser:
    case kNvicIcer:
      return word < 8 ? enabled_[word] : 0;
    case kNvicIspr:
    case kNvicIcpr:
      return word < 8 ? pended_[word] : 0;
    default:
      break;
  }
  if (address == kSystCvr) return systick_count();
  if (address == kSystCsr) {
    const std::uint64_t period = std::uint64_t{remembered(kSystRvr) & kSystMax} + 1;
    const std::uint64_t now = machine_.core_cycles();
    const bool wrapped =
        (now - systick_from_) / period != (systick_flagged_ - systick_from_) / period;
    systick_flagged_ = now;
    return remembered(kSystCsr) | (wrapped ? kSystCsrCountflag : 0u);
  }
  if (address == kDwtCyccnt) {
    const bool runs =
        (remembered(kDemcr) & kDemcrTrcena) != 0 && (remembered(kDwtCtrl) & kDwtCtrlCyccntena) != 0;
    return runs ? static_cast<std::uint32_t>(machine_.core_cycles() - cycle_offset_) : 0;
  }
  return remembered(address);
}

void CoreModel::write(std::uint32_t address, std::uint32_t value) {
  const std::uint32_t word = ((address & 0x7F) / 4) & 7u;
  switch (address & ~0x7Fu) {
    case kNvicIser:
      enabled_[word] |= value;
      return machine_.touch();
    case kNvicIcer:
      enabled_[word] &= ~value;
      return;
    case kNvicIspr:
      pended_[word] |= value;
      return machine_.touch();
    case kNvicIcpr:
      pended_[word] &= ~value;
      return;
    default:
      break;
  }
  if (address == kAircr) {
    if ((value & 0xFFFF0000u) != kAircrKey) return machine_.violate("AIRCR: wrong key");
    if ((value & kAircrSysresetreq) != 0) return machine_.reset(ResetCause::kSoftware);
  }
  if (address == kSystCvr || (address == kSystCsr && (value & kSystCsrEnable) != 0)) {
    systick_from_ = systick_flagged_ = machine_.core_cycles();
  }
  if (address == kSystRvr && value > kSystMax) machine_.violate("SysTick: reload above 24 bits");
  if (address == kDwtCyccnt) cycle_offset_ = machine_.core_cycles() - value;
  words_[address] = value;
}

}  // namespace verp::hal::stm32::model
