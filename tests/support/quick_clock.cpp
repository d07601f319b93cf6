#include <sys/syscall.h>
#include <unistd.h>
#include <x86intrin.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <ctime>

/// with-can loads this into its commands in User-Mode Linux, where a look at the clock takes ten
/// microseconds: half of an emulator's time. CLOCK_MONOTONIC then follows the time stamp counter,
/// which with-can checks, along a line through the kernel's answers. Within a process it never runs
/// backwards; a sleep may end some microseconds early.
namespace {

constexpr std::uint64_t kFirstLine = 200'000'000;  // minimum to measure a speed
constexpr std::uint64_t kLineLasts = 100'000'000;  // tens of milliseconds
constexpr std::uint64_t kPrompt = 500'000;         // a slower answer is inaccurate

/// time_ns = from_ns + (counter - from) * ns_per_cycle
struct Line {
  std::uint64_t from = 0;
  std::uint64_t from_ns = 0;
  double ns_per_cycle = 0;

  std::uint64_t at(std::uint64_t counter) const {
    return from_ns + static_cast<std::uint64_t>(static_cast<double>(counter - from) * ns_per_cycle);
  }
};

Line line;
std::atomic<std::uint32_t> edition{0};  // odd during a write
std::atomic_flag writing = ATOMIC_FLAG_INIT;
std::uint64_t first = 0, first_ns = 0;  // of the first answer

/// False if the line is old or being written.
bool read_line(std::uint64_t& time_ns) {
  const std::uint32_t before = edition.load(std::memory_order_acquire);
  const Line now = line;
  std::atomic_thread_fence(std::memory_order_acquire);
  if (before % 2 != 0 || edition.load(std::memory_order_relaxed) != before) return false;
  const std::uint64_t counter = __rdtsc();
  if (before == 0 || counter - now.from > kLineLasts) return false;
  time_ns = now.at(counter);
  return true;
}

void write_line(const Line& next) {
  edition.fetch_add(1, std::memory_order_acq_rel);
  line = next;
  edition.fetch_add(1, std::memory_order_release);
}

std::uint64_t ask_kernel(std::uint64_t& counter, bool& prompt) {
  timespec now{};
  counter = __rdtsc();  // read first: rather ahead of the kernel than behind
  ::syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &now);
  prompt = __rdtsc() - counter < kPrompt;
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000 +
         static_cast<std::uint64_t>(now.tv_nsec);
}

/// Starts a new line unless another thread does.
std::uint64_t renew_line() {
  std::uint64_t counter = 0;
  bool prompt = false;
  const std::uint64_t time_ns = ask_kernel(counter, prompt);
  if (!prompt || writing.test_and_set(std::memory_order_acquire)) return time_ns;
  if (first == 0) {
    first = counter;
    first_ns = time_ns;
  } else if (counter - first > kFirstLine) {
    write_line({counter, time_ns,
                static_cast<double>(time_ns - first_ns) / static_cast<double>(counter - first)});
  }
  writing.clear(std::memory_order_release);
  return time_ns;
}

/// A new line may begin behind the old one's end.
std::uint64_t never_back(std::uint64_t time_ns) {
  static std::atomic<std::uint64_t> told{0};
  std::uint64_t before = told.load(std::memory_order_relaxed);
  while (before < time_ns && !told.compare_exchange_weak(before, time_ns)) {
  }
  return std::max(before, time_ns);
}

std::uint64_t monotonic_ns() {
  std::uint64_t time_ns = 0;
  if (!read_line(time_ns)) time_ns = renew_line();
  return never_back(time_ns);
}

}  // namespace

extern "C" int clock_gettime(clockid_t id, timespec* time) {
  if (id != CLOCK_MONOTONIC) return static_cast<int>(::syscall(SYS_clock_gettime, id, time));
  const std::uint64_t time_ns = monotonic_ns();
  time->tv_sec = static_cast<std::time_t>(time_ns / 1'000'000'000);
  time->tv_nsec = static_cast<long>(time_ns % 1'000'000'000);
  return 0;
}
