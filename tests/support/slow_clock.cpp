#include <dlfcn.h>

#include <cstdint>
#include <cstdlib>
#include <ctime>

/// with-can loads this into User-Mode Linux, whose clock then runs at 1 / VERP_SLOW_CLOCK of this
/// PC's speed.
///
/// User-Mode Linux asks its PC for the time and wakes by one single-shot timer
/// (arch/um/os-Linux/time.c of Linux 6.1).
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
