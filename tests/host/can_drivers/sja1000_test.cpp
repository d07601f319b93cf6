#include "hal/chip/sja1000/sja1000.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/can/sja1000_model.hpp"

namespace verp::hal::sja1000 {
namespace {

using Driver = Sja1000<test::Sja1000ModelIo>;
constexpr std::uint32_t kPlenty_us = 20'000;
constexpr CanTiming kTiming = Driver::timing(16'000'000, 1'000'000);

CanFrame numbered(std::uint32_t id, unsigned number, std::uint8_t size = 8) {
  CanFrame frame;
  frame.id = id;
  frame.size = size;
  for (unsigned i = 0; i < size; ++i) frame.data[i] = static_cast<std::uint8_t>(number + i);
  return frame;
}

struct Rig {
  Rig() { EXPECT_TRUE(driver.open(kTiming)); }
  ~Rig() { EXPECT_EQ(model.violations(), 0u) << model.first_violation(); }
  void settle() {
    CanFrame frame;
    EXPECT_FALSE(driver.poll(frame, kPlenty_us));
  }
  std::vector<std::uint32_t> heard_ids() {
    std::vector<std::uint32_t> ids;
    for (CanFrame frame; model.wire.far_take(frame);) ids.push_back(frame.id);
    return ids;
  }
  test::Sja1000Model model;
  Driver driver{test::Sja1000ModelIo(model)};
};
using Ids = std::vector<std::uint32_t>;

// Quanta of 8 MHz, 1 + 5 before the sample, 2 behind (data sheet 6.5.1, 6.5.2).
TEST(Sja1000Driver, OpensWithTheTimingOfItsCrystal) {
  Rig rig;
  EXPECT_FALSE(rig.model.in_reset());
  EXPECT_EQ(rig.model.btr(0), 0x40);
  EXPECT_EQ(rig.model.btr(1), 0x14);
}

TEST(Sja1000Driver, RefusesARateThatItsCrystalCannotGive) {
  test::Sja1000Model model;
  Driver driver{test::Sja1000ModelIo(model)};
  EXPECT_FALSE(driver.open(Driver::timing(14'318'180, 1'000'000)));
  EXPECT_FALSE(driver.send(numbered(1, 1)));
}

/// All reads give ones, or zeros.
struct NoChip {
  std::uint8_t value;
  std::uint8_t read8(std::uint32_t) { return value; }
  void write8(std::uint32_t, std::uint8_t) {}
  std::uint64_t now_us() { return 0; }
  bool mask_interrupts() { return false; }
  void unmask_interrupts() {}
  void doze_until(std::uint64_t) {}
};

TEST(Sja1000Driver, KnowsThatThereIsNoChip) {
  for (const std::uint8_t value : {std::uint8_t{0}, std::uint8_t{0xFF}}) {
    EXPECT_FALSE(Sja1000<NoChip>(NoChip{value}).open(kTiming)) << int{value};
  }
}

TEST(Sja1000Driver, AMoreUrgentFrameTakesThePlaceOfOneThatWaitsInTheChip) {
  Rig rig;
  rig.model.wire.hold(true);
  for (const std::uint32_t id : {0x500u, 0x400u, 0x100u, 0x400u}) {
    ASSERT_TRUE(rig.driver.send(numbered(id, id)));
  }
  rig.model.wire.hold(false);
  rig.settle();
  EXPECT_EQ(rig.heard_ids(), (Ids{0x100, 0x400, 0x400, 0x500}));
}

TEST(Sja1000Driver, AFrameOnTheWireStaysThereAndIsSentOnce) {
  Rig rig;
  ASSERT_TRUE(rig.driver.send(numbered(0x500, 1)));
  rig.model.advance(20);
  ASSERT_TRUE(rig.driver.send(numbered(0x100, 2)));
  rig.settle();
  EXPECT_EQ(rig.heard_ids(), (Ids{0x500, 0x100}));
}

// It stays before a later one of its identifier.
TEST(Sja1000Driver, WhatGaveWayKeepsItsOrder) {
  Rig rig;
  rig.model.wire.hold(true);
  ASSERT_TRUE(rig.driver.send(numbered(0x500, 1)));
  ASSERT_TRUE(rig.driver.send(numbered(0x500, 2)));
  ASSERT_TRUE(rig.driver.send(numbered(0x100, 3)));
  rig.model.wire.hold(false);
  rig.settle();
  CanFrame frame;
  for (const unsigned number : {3u, 1u, 2u}) {
    ASSERT_TRUE(rig.model.wire.far_take(frame));
    EXPECT_EQ(frame.data[0], number);
  }
}

TEST(Sja1000Driver, CountsFramesThatFindTheFifoFull) {
  Rig rig;
  for (unsigned i = 0; i < 10; ++i) rig.model.wire.far_send(numbered(0x181, i));
  rig.model.advance(2000);
  unsigned brought = 0;
  for (CanFrame frame; rig.driver.poll(frame, kPlenty_us); ++brought) {
    EXPECT_EQ(frame.data[0], brought);
  }
  EXPECT_EQ(brought, kFifoBytes / (kShortHeaderBytes + 8));
  EXPECT_GE(rig.driver.errors().overruns, 1u);
}

TEST(Sja1000Driver, CountsErrorFramesAndSendsAgain) {
  Rig rig;
  rig.model.wire.spoil(3);
  ASSERT_TRUE(rig.driver.send(numbered(0x123, 1)));
  rig.settle();
  EXPECT_EQ(rig.driver.errors().errors, 3u);
  EXPECT_EQ(rig.heard_ids(), Ids{0x123});
}

TEST(Sja1000Driver, SleepsWhileItWaits) {
  Rig rig;
  const std::uint64_t before_us = rig.driver.now_us();
  ASSERT_TRUE(rig.driver.send(numbered(0x123, 1)));
  rig.settle();
  EXPECT_GE(rig.driver.now_us(), before_us + kPlenty_us);
  EXPECT_GE(rig.model.sleeps(), 1u);
  EXPECT_LE(rig.model.sleeps(), 10u) << "it may only wake for what happens";
}

}  // namespace
}  // namespace verp::hal::sja1000
