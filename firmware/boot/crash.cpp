#include "firmware/boot/crash.hpp"

#include <cstddef>

namespace verp::boot {

struct Kept {
  std::uint32_t mark;
  std::uint32_t check;  ///< over mark and record: RAM is random after power-up
  CrashRecord record;
};
static_assert(sizeof(Kept) <= 64, "room in sections.ld");

}  // namespace verp::boot

/// No initialiser runs there (sections.ld).
extern "C" verp::boot::Kept verp_kept;

namespace verp::boot {
namespace {

constexpr std::uint32_t kFresh = 0xC0A5DEADu;  ///< a record not yet taken
constexpr std::uint32_t kTaken = 0x7A4E0000u;
constexpr std::size_t kWords = sizeof(CrashRecord) / 4;

std::uint32_t latest_tick = 0;

std::uint32_t check_of(const Kept& of) {
  std::uint32_t words[kWords];
  __builtin_memcpy(words, &of.record, sizeof words);
  std::uint32_t sum = of.mark;
  for (const std::uint32_t word : words) sum = ((sum << 5) | (sum >> 27)) ^ (word * 0x9E3779B1u);
  return sum;
}
bool is_whole() {
  return verp_kept.check == check_of(verp_kept);
}
void wait_for_memory() {
#ifdef __riscv
  __asm__ volatile("fence" ::: "memory");
#else
  __asm__ volatile("dsb" ::: "memory");
#endif
}
void seal(std::uint32_t mark) {
  verp_kept.mark = mark;
  verp_kept.check = check_of(verp_kept);
  wait_for_memory();
}

}  // namespace

void note_tick(std::uint32_t tick) {
  latest_tick = tick;
}

void keep_crash(const FaultReport& report) {
  const bool known = is_whole() && (verp_kept.mark == kFresh || verp_kept.mark == kTaken);
  const std::uint32_t before = known ? verp_kept.record.crashes : 0;
  verp_kept.record = {.pc = report.pc,
                      .lr = report.lr,
                      .cause = report.cause,
                      .address = report.address,
                      .stack_overflow = report.stack_overflow ? 1u : 0u,
                      .tick = latest_tick,
                      .crashes = before + 1};
  seal(kFresh);
}

bool take_crash(CrashRecord& record) {
  if (!is_whole() || verp_kept.mark != kFresh) return false;
  record = verp_kept.record;
  seal(kTaken);
  return true;
}

void forget_crashes() {
  if (!is_whole()) verp_kept.record = {};
  verp_kept.record.crashes = 0;
  seal(kTaken);
}

}  // namespace verp::boot
