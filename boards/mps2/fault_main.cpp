#include "board.hpp"
#include "boards/mps2/arguments.hpp"
#include "firmware/boot/boot.hpp"
#include "firmware/boot/crash.hpp"
#include "hal/chip/semihosting/semihosting.hpp"

/// fault_<board> overflow|jump|read: causes that fault, keeps the crash record and resets. The
/// second start prints it.
namespace {

using verp::hal::semihosting::print;

constexpr std::uint32_t kTick = 1234;
using verp::board::kNowhere;

bool same(const char* a, const char* b) {
  while (*a != 0 && *a == *b) ++a, ++b;
  return *a == *b;
}

constexpr std::uint32_t kDeep = 1'000'000;  // 256-byte frames: more than any memory here

__attribute__((noinline)) std::uint32_t overflow(std::uint32_t depth) {
  volatile std::uint32_t frame[64] = {depth};
  return depth == kDeep ? 0 : overflow(depth + 1) + frame[0];
}

void break_down(const char* how) {
  verp::boot::note_tick(kTick);
  if (same(how, "overflow")) overflow(1);
  if (same(how, "jump")) reinterpret_cast<void (*)()>(kNowhere | 1u)();
  if (same(how, "read")) {
    static_cast<void>(*reinterpret_cast<const volatile std::uint32_t*>(kNowhere));
  }
}

bool is_right(const verp::boot::CrashRecord& crash, const char* how) {
  if (crash.tick != kTick || crash.crashes != 1) return false;
  if (same(how, "overflow")) return crash.stack_overflow != 0;
  if (crash.stack_overflow != 0 || crash.cause == 0) return false;
  return same(how, "jump") ? (crash.pc | 1u) == (kNowhere | 1u) : crash.address == kNowhere;
}

}  // namespace

extern "C" int verp_main() {
  const verp::board::Arguments arguments;
  verp::boot::CrashRecord crash;
  if (!verp::boot::take_crash(crash)) {
    break_down(arguments[1]);
    print("fault: nothing broke\n");
    return 1;
  }
  const bool once = !verp::boot::take_crash(crash);
  const bool good = once && is_right(crash, arguments[1]);
  print(good ? "fault: kept\n" : "fault: the record is not that of the crash\n");
  return good ? 0 : 1;
}

extern "C" void verp_exit(int status) {
  verp::hal::semihosting::exit(status);
}

extern "C" void verp_fault(const verp::boot::FaultReport& report) {
  verp::boot::keep_crash(report);
  // AIRCR: SYSRESETREQ (ARMv7-M ARM, B3.2.6).
  *reinterpret_cast<volatile std::uint32_t*>(0xE000ED0Cu) = 0x05FA0004u;
  for (;;) {
  }
}
