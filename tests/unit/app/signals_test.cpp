#include "firmware/app/signals.hpp"

#include <gtest/gtest.h>

namespace verp::app {
namespace {

constexpr std::uint64_t kTick_us = 8000;

bool same(const Tone& a, const Tone& b) {
  return a.hz == b.hz && a.duration_ms == b.duration_ms;
}

TEST(Signals, TellAGoodStartFromARefusedOne) {
  EXPECT_TRUE(same(Signals::at_start(true), Signals::kReady));
  EXPECT_TRUE(same(Signals::at_start(false), Signals::kRefused));
}

TEST(Signals, SayEachFaultOnceWhenItComes) {
  Signals signals;
  std::uint64_t now_us = 0;
  EXPECT_EQ(signals.after_tick(now_us, 0).duration_ms, 0u);
  for (int bit = 0; bit < 16; ++bit) {
    const std::uint32_t fault = 1u << bit;
    if (fault == safety::kFaultVoltage) continue;
    EXPECT_TRUE(same(signals.after_tick(now_us += kTick_us, fault), Signals::kFault)) << bit;
    for (int tick = 0; tick < 500; ++tick) {
      EXPECT_EQ(signals.after_tick(now_us += kTick_us, fault).duration_ms, 0u);
    }
  }
  EXPECT_EQ(signals.after_tick(now_us += kTick_us, 0).duration_ms, 0u);
  EXPECT_TRUE(same(signals.after_tick(now_us += kTick_us, 1), Signals::kFault)) << "it came again";
}

TEST(Signals, NotesAreNotSaid) {
  Signals signals;
  for (int bit = 16; bit < 32; ++bit) {
    EXPECT_EQ(signals.after_tick(static_cast<std::uint64_t>(bit) * kTick_us, 1u << bit).duration_ms,
              0u);
  }
}

TEST(Signals, RepeatALowSupplyOnceASecondUntilItIsBetter) {
  Signals signals;
  int low = 0, faults = 0;
  std::uint64_t now_us = 0;
  for (; now_us < 10'000'000; now_us += kTick_us) {
    const Tone tone = signals.after_tick(now_us, safety::kFaultVoltage);
    faults += same(tone, Signals::kFault) ? 1 : 0;
    low += same(tone, Signals::kLowSupply) ? 1 : 0;
  }
  EXPECT_EQ(faults, 1);
  EXPECT_GE(low, 8);
  EXPECT_LE(low, 10);
  for (int tick = 0; tick < 500; ++tick) {
    EXPECT_EQ(signals.after_tick(now_us += kTick_us, 0).duration_ms, 0u);
  }
}

}  // namespace
}  // namespace verp::app
