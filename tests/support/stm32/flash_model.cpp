#include "tests/support/stm32/flash_model.hpp"

#include "tests/support/stm32/rcc_model.hpp"
#include "tests/support/stm32/registers/flash_table.hpp"

namespace verp::hal::stm32::model {

using namespace flash;

FlashModel::FlashModel(Machine& machine)
    : Bank(machine, "FLASH", base::kFlash, flash::table(machine.family()), {}),
      option_bytes_(reg(kOptcr)) {}

void FlashModel::reset() {
  Bank::reset();
  reg(kOptcr) = option_bytes_;
  done_at_ = kNever;
  keys_ = option_keys_ = 0;
  key_locked_ = error_pending_ = false;
}

std::uint32_t FlashModel::wait_states() const {
  return reg(kAcr) & (machine().family() == Family::kF405 ? kAcrLatencyF405 : kAcrLatency);
}

void FlashModel::key_written(std::uint32_t key) {
  const std::uint32_t wanted = keys_ == 0 ? kKey1 : kKey2;
  if (key_locked_ || !has(kCr, kCrLock) || key != wanted) {
    violate(key_locked_ || key != wanted ? "wrong key" : "key although CR is unlocked");
    key_locked_ = has(kCr, kCrLock);  // until the next reset
    keys_ = 0;
    return;
  }
  if (++keys_ < 2) return;
  keys_ = 0;
  clear(kCr, kCrLock);
}

void FlashModel::option_key_written(std::uint32_t key) {
  if (key != (option_keys_ == 0 ? kOptKey1 : kOptKey2)) {
    violate("wrong option key");
    option_keys_ = 0;
    return;
  }
  if (++option_keys_ < 2) return;
  option_keys_ = 0;
  clear(kOptcr, kOptcrOptlock);
}

bool FlashModel::may_write(std::uint32_t offset, std::uint32_t raw) {
  if (offset == kCr && has(kCr, kCrLock) && raw != kCrLock) {
    violate("write to CR while it is locked");
    return false;
  }
  if (offset == kCr && has(kSr, kSrBsy)) {
    violate("write to CR while BSY");
    return false;
  }
  if (offset == kOptcr && has(kOptcr, kOptcrOptlock) && raw != reg(kOptcr)) {
    violate("write to OPTCR while it is locked");
    return false;
  }
  if (offset == kOptcr && has(kSr, kSrBsy)) {
    violate("write to OPTCR while BSY");
    return false;
  }
  const bool f4 = machine().family() != Family::kF746;
  // Each reset bit requires its cache to be off (RM0090 3.9.1).
  const auto hot = [&](std::uint32_t reset_bit, std::uint32_t enable_bit) {
    return (raw & reset_bit) != 0 && has(kAcr, enable_bit);
  };
  const bool wrong = f4 ? hot(kAcrIcrstF4, kAcrIcenF4) || hot(kAcrDcrstF4, kAcrDcenF4)
                        : hot(kAcrArtrstF7, kAcrArtenF7);
  if (offset == kAcr && wrong) {
    violate("cache reset while it is enabled");
  }
  return true;
}

void FlashModel::on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) {
  if (offset == kKeyr) key_written(raw);
  if (offset == kOptkeyr) option_key_written(raw);
  if (offset == kAcr) machine().rcc().check_limits();
  if (offset == kOptcr) option_written(raw, old);
  if (offset != kCr) return;
  const std::uint32_t modes = reg(kCr) & (kCrPg | kCrSer | kCrMer);
  if ((modes & (modes - 1)) != 0) violate("more than one of PG, SER and MER");
  if ((raw & kCrStrt) != 0) {
    if (has(kCr, kCrSer) && modes == kCrSer) {
      start_erase();
    } else {
      violate("STRT without SER (mass erase is not modelled)");
      clear(kCr, kCrStrt);
    }
  }
}

void FlashModel::option_written(std::uint32_t raw, std::uint32_t old) {
  constexpr std::uint32_t kControl = kOptcrOptlock | kOptcrOptstrt;
  if (options == Options::kFrozen) reg(kOptcr) = (raw & kControl) | (old & ~kControl);
  if ((raw & kOptcrOptstrt) == 0) return;
  error_pending_ = options == Options::kFail;
  if (options == Options::kTake) option_bytes_ = (reg(kOptcr) & ~kControl) | kOptcrOptlock;
  begin(erase_time_per_kb);
}

void FlashModel::begin(Time takes) {
  set(kSr, kSrBsy);
  done_at_ = machine().now() + takes;
  machine().touch();
}

void FlashModel::run() {
  if (busy_stuck || done_at_ > machine().now()) return;
  done_at_ = kNever;
  clear(kSr, kSrBsy);
  clear(kCr, kCrStrt);
  clear(kOptcr, kOptcrOptstrt);
  if (error_pending_) {
    set(kSr, kSrOperr);
  } else if (has(kCr, kCrEopie)) {
    set(kSr, kSrEop);
  }
  error_pending_ = false;
}

bool FlashModel::interrupt(unsigned irq) const {
  return irq == irq::kFlash &&
         ((has(kCr, kCrEopie) && has(kSr, kSrEop)) || (has(kCr, kCrErrie) && has(kSr, kSrOperr)));
}

void FlashModel::fail(std::uint32_t flag, const char* why) {
  violate(why);
  set(kSr, flag);
  if (has(kCr, kCrErrie)) set(kSr, kSrOperr);
}

int FlashModel::sector_of(std::uint32_t address) const {
  const Limits& chip = limits(machine().family());
  for (std::uint32_t i = 0; i < chip.sector_count; ++i) {
    if (address - chip.sectors[i].address < chip.sectors[i].bytes) return static_cast<int>(i);
  }
  return -1;
}

std::uint32_t FlashModel::random() {  // xorshift32 (Marsaglia 2003)
  random_ ^= random_ << 13;
  random_ ^= random_ >> 17;
  random_ ^= random_ << 5;
  return random_ >> 8;
}

bool FlashModel::power_goes() {
  if (!cut_planned_ || until_cut_-- > 0) return false;
  cut_planned_ = false;
  return true;
}

void FlashModel::power_on() {
  cut_planned_ = false;
  const std::uint32_t mood = random() % 4;
  for (const auto& [address, bits] : unsure_) {
    if (bits == 0) continue;
    const std::uint32_t fallen = mood == 0 ? 0xFFu : (mood == 1 ? 0u : random());
    byte(address) = static_cast<std::uint8_t>((byte(address) & ~bits) | (fallen & bits));
  }
}

void FlashModel::start_erase() {
  const Limits& chip = limits(machine().family());
  const std::uint32_t number = (reg(kCr) & kCrSnb) >> kCrSnbShift;
  if (number >= chip.sector_count) {
    clear(kCr, kCrStrt);
    return fail(kSrPgserr, "erase of a sector that isn't there");
  }
  if ((reg(kSr) & kSrErrors) != 0) violate("erase while error flags are set");
  if ((protected_sectors >> number & 1u) != 0) {
    clear(kCr, kCrStrt);
    set(kSr, kSrWrperr);
    return;
  }
  ++erases_;
  const Sector& sector = chip.sectors[number];
  const bool cut = power_goes();
  const bool failed = !cut && fail_next > 0;
  if (failed) --fail_next;
  const auto end = static_cast<std::uint32_t>(sector.address + sector.bytes);
  unsure_.erase(unsure_.lower_bound(sector.address), unsure_.lower_bound(end));
  if (cut || failed) {
    for (std::uint32_t at = sector.address; at < end; ++at) {
      if (cut) unsure_[at] = 0xFF;
      if (failed && random() % 2 == 0) byte(at) = 0xFF;
    }
  } else {
    chunks_.erase(chunks_.lower_bound(sector.address / kChunkBytes),
                  chunks_.lower_bound(end / kChunkBytes));
  }
  error_pending_ = failed;
  if (cut) return machine().power_off();
  begin(erase_time_per_kb * (sector.bytes / 1024) >> ((reg(kCr) & kCrPsize) >> kCrPsizeShift));
}

std::uint32_t FlashModel::memory_read(std::uint32_t address, unsigned width) {
  if (has(kSr, kSrBsy) && !busy_stuck) machine().advance(done_at_ - machine().now());
  if (address % width != 0) violate("unaligned read");
  std::uint32_t value = 0;
  for (unsigned i = 0; i < width; ++i) {
    const auto chunk = chunks_.find(address / kChunkBytes);
    const std::uint32_t at = (address + i) % kChunkBytes;
    value |= (chunk == chunks_.end() ? 0xFFu : chunk->second.bytes[at]) << (8 * i);
  }
  return value;
}

void FlashModel::memory_write(std::uint32_t address, std::uint32_t value, unsigned width) {
  const std::uint32_t psize = 1u << ((reg(kCr) & kCrPsize) >> kCrPsizeShift);
  const int sector = sector_of(address);
  if (has(kSr, kSrBsy)) violate("program while BSY");
  if (!has(kCr, kCrPg)) return fail(kSrPgserr, "write to the memory without PG");
  if (width != psize) return fail(kSrPgperr, "write of another width than PSIZE");
  if (address % width != 0) return fail(kSrPgaerr, "unaligned program");
  if ((reg(kSr) & kSrErrors) != 0) return violate("program while error flags are set");
  if (sector < 0 || (protected_sectors >> sector & 1) != 0) {
    set(kSr, kSrWrperr);
    return;
  }
  ++programs_;
  const bool cut = power_goes();
  const bool failed = !cut && fail_next > 0;
  if (failed) --fail_next;
  for (unsigned i = 0; i < width; ++i) {
    std::uint8_t& cell = byte(address + i);
    const auto zeros = static_cast<std::uint8_t>(~(value >> (8 * i)));
    if (cut) {
      unsure_[address + i] = static_cast<std::uint8_t>(unsure_[address + i] | (cell & zeros));
    } else {
      const auto cleared = static_cast<std::uint8_t>(failed ? zeros & random() : zeros);
      cell = static_cast<std::uint8_t>(cell & ~cleared);
      const auto unsure = unsure_.find(address + i);
      if (unsure != unsure_.end()) {
        unsure->second = static_cast<std::uint8_t>(unsure->second & ~cleared);
      }
    }
  }
  error_pending_ = failed;
  if (cut) return machine().power_off();
  begin(program_time);
}

}  // namespace verp::hal::stm32::model
