#include "firmware/app/tick_log.hpp"

#include <gtest/gtest.h>

#include "tests/unit/app/operator_bench.hpp"

namespace verp::app::test {
namespace {

using Log = TickLog;

void keep(Log& log, std::uint32_t from, std::uint32_t to) {
  static State state;
  for (std::uint32_t tick = from; tick < to; ++tick) {
    TickRecord record;
    record.inputs.tick = tick;
    state.admit.tick = tick;
    log.keep(record, state);
  }
}
std::uint32_t tick_at(const Log& log, std::size_t place) {
  TickRecord record;
  log.read(ImageKind::kTicks, place * sizeof record, reinterpret_cast<std::uint8_t*>(&record),
           sizeof record);
  return record.inputs.tick;
}

TEST(TickLog, KeepsEachOfTheLastTicksInThePlaceOfItsNumber) {
  for (const std::uint32_t ticks : {1u, 5u, 15u, 16u, 17u, 40u}) {
    Log& log = renewed<Log>(no_images);
    keep(log, 100, 100 + ticks);
    ASSERT_EQ(log.size(ImageKind::kTicks), Log::kTicks * sizeof(TickRecord));
    const std::uint32_t kept = ticks < Log::kTicks ? ticks : std::uint32_t{Log::kTicks};
    for (std::uint32_t i = 0; i < kept; ++i) {
      const std::uint32_t tick = 99 + ticks - i;
      EXPECT_EQ(tick_at(log, tick % Log::kTicks), tick);
    }
  }
}

TEST(TickLog, WhatIsHeldStandsStillWhileTheLoopGoesOn) {
  Log& log = renewed<Log>(no_images);
  keep(log, 0, 30);
  log.hold(Log::kAll);
  keep(log, 30, 35);
  static HeldTick held;
  log.read(ImageKind::kState, 0, reinterpret_cast<std::uint8_t*>(&held), sizeof held);
  EXPECT_EQ(held.record.inputs.tick, 29u);
  EXPECT_EQ(held.state.admit.tick, 29u);
  EXPECT_EQ(tick_at(log, 29 % Log::kTicks), 29u);
  log.hold(Log::kNothing);
  keep(log, 35, 36);
  log.hold(Log::kAll);
  EXPECT_EQ(tick_at(log, 35 % Log::kTicks), 35u);
  EXPECT_EQ(tick_at(log, 30 % Log::kTicks), 14u) << "it was not kept";
}

TEST(TickLog, TicksGoOnWhileOnlyTheStateIsHeld) {
  Log& log = renewed<Log>(no_images);
  keep(log, 0, 30);
  log.hold(Log::kStateOnly);
  keep(log, 30, 35);
  static HeldTick held;
  log.read(ImageKind::kState, 0, reinterpret_cast<std::uint8_t*>(&held), sizeof held);
  EXPECT_EQ(held.record.inputs.tick, 29u);
  EXPECT_EQ(tick_at(log, 34 % Log::kTicks), 34u);
}

TEST(TickLog, PiecesMakeTheWhole) {
  Log& log = renewed<Log>(no_images);
  keep(log, 0, 21);
  log.hold(Log::kAll);
  static std::uint8_t whole[Log::kTicks * sizeof(TickRecord)];
  static std::uint8_t pieces[sizeof whole];
  log.read(ImageKind::kTicks, 0, whole, sizeof whole);
  for (const std::size_t size : {7u, 128u, 889u}) {
    __builtin_memset(pieces, 0, sizeof pieces);
    for (std::size_t at = 0; at < sizeof whole; at += size) {
      const std::size_t left = sizeof whole - at;
      log.read(ImageKind::kTicks, at, pieces + at, left < size ? left : size);
    }
    EXPECT_EQ(__builtin_memcmp(whole, pieces, sizeof whole), 0) << size;
  }
}

TEST(TickLog, StateIsThereOnlyWhileItIsHeld) {
  Log& log = renewed<Log>(no_images);
  log.hold(Log::kAll);
  EXPECT_EQ(log.size(ImageKind::kState), 0u) << "there was no tick yet";
  log.hold(Log::kNothing);
  keep(log, 0, 3);
  EXPECT_EQ(log.size(ImageKind::kState), 0u);
  log.hold(Log::kAll);
  EXPECT_EQ(log.size(ImageKind::kState), sizeof(HeldTick));
  EXPECT_EQ(log.commit(ImageKind::kState, 0), kWrongWindowCrc);
  EXPECT_EQ(log.size(ImageKind::kParams), 0u) << "other images are the other store's";
}

TEST(TickLog, RegisterTickHoldHoldsAndAControllerWithoutALogRefusesIt) {
  Log& log = renewed<Log>(no_images);
  auto& bench = renewed<Bench>(log);
  static const Outputs outputs;
  for (std::uint32_t tick = 0; tick < 3; ++tick) {
    TickRecord record;
    record.inputs.tick = tick;
    bench.device.record(record, bench.state, outputs);
  }
  EXPECT_TRUE(bench.write(reg("tick_hold"), std::uint8_t{1}) == dxl::Error::kNone);
  EXPECT_EQ(log.size(ImageKind::kState), sizeof(HeldTick));
  auto& without = renewed<Bench>(no_images);
  EXPECT_TRUE(without.write(reg("tick_hold"), std::uint8_t{1}) == dxl::Error::kResultFail);
}

}  // namespace
}  // namespace verp::app::test
