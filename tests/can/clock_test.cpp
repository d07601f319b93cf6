#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <ctime>
#include <thread>

#include "host/os/link/system_clock.hpp"

namespace verp::test {
namespace {

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::int64_t look() {
  timespec now{};
  EXPECT_EQ(::clock_gettime(CLOCK_MONOTONIC, &now), 0);
  return nanoseconds(now);
}

std::int64_t ask_kernel() {
  timespec now{};
  EXPECT_EQ(::syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &now), 0);
  return nanoseconds(now);
}

constexpr std::int64_t kLong_ns = 500'000'000, kNear_ns = 1'000'000;

TEST(ClockOfCanTests, IsTheKernels) {
  const std::int64_t end_ns = ask_kernel() + kLong_ns;
  for (std::int64_t after = 0; after < end_ns;) {
    const std::int64_t before = ask_kernel();
    const std::int64_t here = look();
    after = ask_kernel();
    ASSERT_GE(here, before - kNear_ns);
    ASSERT_LE(here, after + kNear_ns);
  }
}

TEST(ClockOfCanTests, NeverGoesBackWhicheverThreadLooks) {
  std::atomic<std::int64_t> latest{0};
  std::atomic<int> went_back{0};
  const auto watch = [&] {
    const std::int64_t end_ns = look() + kLong_ns;
    for (std::int64_t now = 0; now < end_ns;) {
      const std::int64_t before = latest.load();
      now = look();
      if (now < before) ++went_back;
      latest.store(now);
    }
  };
  std::thread other(watch);
  watch();
  other.join();
  EXPECT_EQ(went_back, 0);
}

// `verp run` counts periods by sleeps.
TEST(ClockOfCanTests, SleepsUntilItsOwnTime) {
  const std::uint64_t end_ns = link::monotonic_ns() + kLong_ns;
  for (std::uint64_t most_ns = 0; link::monotonic_ns() < end_ns;
       most_ns = (most_ns + 997) % 50'000) {
    const std::uint64_t until_ns = link::monotonic_ns() + most_ns;
    link::sleep_until_ns(until_ns);
    ASSERT_GE(link::monotonic_ns(), until_ns);
  }
}

}  // namespace
}  // namespace verp::test
