#include <dlfcn.h>

#include <cstdint>
#include <cstdlib>
#include <ctime>

/// Loaded into User-Mode Linux by with-can: the virtual machine's clock goes at a part of the speed
/// of this PC's, 1 / VERP_SLOW_CLOCK. All that is in there shares its one clock, so a robot and the
/// PC that drives it only see a faster machine: what this PC takes from the virtual machine, for
/// other tests or another guest, is that much less of their period.
///
/// Of its PC, User-Mode Linux asks the time, and has itself waked by one timer that runs once
/// (arch/um/os-Linux/time.c of Linux 6.1); it writes no time into what others read.
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

std::int64_t factor() {
  static const std::int64_t value = std::atoll(std::getenv("VERP_SLOW_CLOCK"));
  return value;
}

std::int64_t nanoseconds(const timespec& time) {
  return time.tv_sec * kSecond + time.tv_nsec;
}

timespec as_time(std::int64_t nanoseconds) {
  return {static_cast<std::time_t>(nanoseconds / kSecond),
          static_cast<long>(nanoseconds % kSecond)};
}

template <class Function>
Function original(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int clock_gettime(clockid_t id, timespec* time) noexcept {
  static const auto ask = original<int (*)(clockid_t, timespec*)>("clock_gettime");
  const int result = ask(id, time);
  if (result != 0 || id != CLOCK_MONOTONIC) return result;
  *time = as_time(nanoseconds(*time) / factor());
  return result;
}

extern "C" int timer_settime(timer_t timer, int flags, const itimerspec* wanted,
                             itimerspec* before) noexcept {
  static const auto set =
      original<int (*)(timer_t, int, const itimerspec*, itimerspec*)>("timer_settime");
  const itimerspec slow{as_time(nanoseconds(wanted->it_interval) * factor()),
                        as_time(nanoseconds(wanted->it_value) * factor())};
  return set(timer, flags, &slow, before);
}
