#include "firmware/app/start_fault.hpp"

#include <gtest/gtest.h>

#include "hal/fake/fake_watchdog.hpp"
#include "hal/fake/manual_clock.hpp"

namespace verp::app {
namespace {

using table::StartFault;

constexpr StartFault kAll[] = {
    StartFault::kSelfTest, StartFault::kTimer,    StartFault::kOperatorPort, StartFault::kServoPort,
    StartFault::kPeriod,   StartFault::kWatchdog, StartFault::kProtocol};

/// Power comes only after the port.
struct Servos {
  bool open() {
    EXPECT_FALSE(powered);
    return opened = opens;
  }
  void power(bool on) {
    EXPECT_TRUE(!on || opened) << "power before there is anybody to give orders";
    powered = on;
  }
  void release() {
    EXPECT_TRUE(opened);
    ++releases;
  }
  bool opens = true;
  bool opened = false;
  bool powered = true;
  int releases = 0;
};

TEST(OpenServos, GivesPowerIfNothingIsWrong) {
  Servos servos;
  EXPECT_TRUE(open_servos(servos, StartFault::kNone) == StartFault::kNone);
  EXPECT_TRUE(servos.powered);
  EXPECT_EQ(servos.releases, 0);
}

TEST(OpenServos, APortThatDoesNotOpenIsAFaultAndLeavesThemWithoutPower) {
  Servos servos{.opens = false};
  EXPECT_TRUE(open_servos(servos, StartFault::kNone) == StartFault::kServoPort);
  EXPECT_FALSE(servos.powered);
}

TEST(OpenServos, AfterAnyOtherFaultTheyLackPowerAndAreToldToLetGo) {
  for (const StartFault fault : kAll) {
    for (const bool opens : {false, true}) {
      Servos servos{.opens = opens};
      EXPECT_TRUE(open_servos(servos, fault) == fault) << "the first fault is the one to be told";
      EXPECT_FALSE(servos.powered);
      EXPECT_EQ(servos.releases, opens ? 1 : 0);
    }
  }
}

constexpr std::uint32_t kPeriod_us = 10'000, kTimeout_us = 100'000;

TEST(LoopGuard, StartsClockAndWatchdogForAsManyLoopsAsThereAre) {
  hal::ManualClock clock;
  hal::FakeWatchdog dog;
  LoopGuard guard(dog, true);
  for (int loop = 0; loop < 3; ++loop) {
    Pacer pacer(clock);
    EXPECT_TRUE(guard.begin(pacer, kPeriod_us, kTimeout_us) == StartFault::kNone) << loop;
    EXPECT_EQ(pacer.next().periods, 1u);
    dog.feed();
  }
  dog.advance(hal::kWatchdogSlack * kTimeout_us + 1);
  EXPECT_TRUE(dog.caused_reset()) << "it is armed";
}

// A person needs time to look; the watchdog must not bite meanwhile.
TEST(LoopGuard, AClockThatRefusesIsAFaultAndArmsNothing) {
  hal::ManualClock clock;
  hal::FakeWatchdog dog;
  LoopGuard guard(dog, true);
  Pacer pacer(clock);
  EXPECT_TRUE(guard.begin(pacer, 0, kTimeout_us) == StartFault::kPeriod);
  dog.advance(1'000'000'000);
  EXPECT_FALSE(dog.caused_reset());
}

TEST(LoopGuard, AWatchdogThatRefusesIsAFaultWhereThereIsOne) {
  hal::ManualClock clock;
  hal::FakeWatchdog dog;
  Pacer pacer(clock);
  EXPECT_TRUE(LoopGuard(dog, true).begin(pacer, kPeriod_us, 0) == StartFault::kWatchdog);
  EXPECT_TRUE(LoopGuard(dog, false).begin(pacer, kPeriod_us, 0) == StartFault::kNone);
}

struct Seen {
  int flashes = 0, beeps = 0, changes = 0;
  std::uint64_t longest_dark_ms = 0;
};
Seen watch(StartFault fault, std::uint64_t from_ms, std::uint64_t to_ms) {
  LifeSign sign;
  Seen seen;
  bool lit = false;
  std::uint64_t dark_ms = 0;
  for (std::uint64_t ms = from_ms; ms < to_ms; ++ms) {
    const LifeSign::Now now = sign.at(ms * 1000, fault);
    EXPECT_EQ(now.changed, now.lit != lit);
    seen.flashes += now.lit && !lit ? 1 : 0;
    seen.beeps += now.tone.duration_ms > 0 ? 1 : 0;
    lit = now.lit;
    dark_ms = lit ? 0 : dark_ms + 1;
    seen.longest_dark_ms = dark_ms > seen.longest_dark_ms ? dark_ms : seen.longest_dark_ms;
  }
  return seen;
}

TEST(LifeSign, BlinksOnceASecondAndIsSilentWhileAllIsWell) {
  const Seen seen = watch(StartFault::kNone, 0, 60'000);
  EXPECT_EQ(seen.flashes, 60);
  EXPECT_EQ(seen.beeps, 0);
  EXPECT_EQ(seen.longest_dark_ms, 500u);
}

// The observer counts the fault's number between two pauses.
TEST(LifeSign, CountsTheFaultOutByLightAndSound) {
  for (const StartFault fault : kAll) {
    const auto number = static_cast<int>(fault);
    const std::uint64_t cycle_ms =
        (2 * LifeSign::kFlash_us * static_cast<std::uint64_t>(number) + LifeSign::kPause_us) / 1000;
    const Seen seen = watch(fault, 0, 10 * cycle_ms);
    EXPECT_EQ(seen.flashes, 10 * number);
    EXPECT_EQ(seen.beeps, seen.flashes);
    EXPECT_GE(seen.longest_dark_ms, 2000u) << "the pause that tells one count from the next";
    EXPECT_EQ(watch(fault, cycle_ms, 2 * cycle_ms).flashes, number);
    EXPECT_GE(number, 2) << "one flash is the sign of life";
  }
}

}  // namespace
}  // namespace verp::app
