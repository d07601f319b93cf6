#include <gtest/gtest.h>

#include <cstdint>

#include "tests/unit/app/operator_bench.hpp"

namespace verp::app::test {
namespace {

using dxl::Error;

// Only a new write of 0 restores power.
TEST(OperatorOrders, ToRelaxIsToldOnceForEachTimeItIsWritten) {
  Bench& bench = fresh_bench();
  EXPECT_FALSE(bench.device.take_relax()) << "0 stands there from the start";
  for (int times = 0; times < 3; ++times) {
    bench.relax();
    EXPECT_TRUE(bench.device.take_relax());
    EXPECT_FALSE(bench.device.take_relax());
  }
  EXPECT_TRUE(bench.write(reg("request"), std::uint8_t{1}) == Error::kNone);
  EXPECT_TRUE(bench.write(reg("walk_vx"), std::int16_t{0}) == Error::kNone);
  EXPECT_FALSE(bench.device.take_relax());
}

// The core rises on a level. After a reset, a program that repeats its order to stand must not
// raise the robot.
TEST(OperatorOrders, ToStandOrWalkAreRefusedAfterEachStartUntilOneToRelaxWasGiven) {
  using Cause = table::ResetCause;
  for (const Cause cause : {Cause::kUnknown, Cause::kPower, Cause::kPin, Cause::kSoftware,
                            Cause::kWatchdog, Cause::kLowPower, Cause::kFault}) {
    const OperatorSetup setup = {.reset_cause = cause};
    Bench& bench = renewed<Bench>(no_images, setup);
    for (std::uint32_t tick = 0; tick < 20; ++tick) {
      const std::uint8_t order[] = {static_cast<std::uint8_t>(1 + tick % 2), 5, 0x2C, 0x01};
      EXPECT_TRUE(bench.write_bytes(reg("request"), order, sizeof order).error ==
                  Error::kResultFail);
      const OperatorOrder held = bench.device.order(tick);
      EXPECT_EQ(held.flags, 0) << "nor is it fresh";
      EXPECT_TRUE(held.command.request == Request::kRelax);
      EXPECT_EQ(held.command.vx_tenth_mm_s, 0) << "a write is done whole or not at all";
    }
    bench.write(reg("walk_vx"), std::int16_t{7});
    EXPECT_TRUE(bench.write(reg("request"), std::uint8_t{1}) == Error::kResultFail)
        << "another register is no request to relax";
    bench.relax();
    for (const int request : {2, 1, 0, 1}) {
      EXPECT_TRUE(bench.write(reg("request"), static_cast<std::uint8_t>(request)) == Error::kNone);
    }
  }
}

TEST(OperatorOrders, AKeptRequestToRelaxCountsFromItsActionOn) {
  Bench& bench = fresh_bench();
  const std::uint8_t relax = 0;
  bench.send(
      dxl::encode_reg_write(bench.frame, sizeof bench.frame, bench.id, reg("request"), &relax, 1));
  EXPECT_TRUE(bench.write(reg("request"), std::uint8_t{1}) == Error::kResultFail);
  bench.plain(dxl::Instruction::kAction);
  EXPECT_TRUE(bench.write(reg("request"), std::uint8_t{1}) == Error::kNone);
}

TEST(OperatorOrders, AreFreshInTheOneTickThatFollowsAWrite) {
  Bench& bench = relaxed_bench();
  EXPECT_EQ(bench.device.order(0).flags, 0);
  const std::uint8_t order[] = {2, 5, 0x2C, 0x01, 0xCE, 0xFF, 0x64, 0};  // walk, 30, -5 mm/s, turn
  EXPECT_TRUE(bench.write_bytes(reg("request"), order, sizeof order).error == Error::kNone);
  const OperatorOrder first = bench.device.order(1);
  EXPECT_EQ(first.flags, kCommandFresh);
  EXPECT_TRUE(first.command.request == Request::kWalk);
  EXPECT_EQ(first.command.sequence, 5);
  EXPECT_EQ(first.command.vx_tenth_mm_s, 300);
  EXPECT_EQ(first.command.vy_tenth_mm_s, -50);
  EXPECT_EQ(first.command.wz_mrad_s, 100);
  const OperatorOrder second = bench.device.order(2);
  EXPECT_EQ(second.flags, 0) << "not fresh any more";
  EXPECT_TRUE(second.command.request == Request::kWalk) << "but it stands";
  EXPECT_EQ(second.command.vx_tenth_mm_s, 300);
}

TEST(OperatorOrders, TheSameOrderAgainIsFreshAgain) {
  Bench& bench = relaxed_bench();
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(bench.write(reg("request"), std::uint8_t{1}) == Error::kNone);
    EXPECT_EQ(bench.device.order(0).flags, kCommandFresh);
  }
}

// Erasing flash stops the processor for up to two seconds. The operator may be gone afterwards.
TEST(OperatorOrders, DoNotOutliveALoopThatStoodStill) {
  const auto hold_ticks = static_cast<std::uint32_t>(1e6F * kRobot.tuning.safety.command_hold_s /
                                                     static_cast<float>(kRobot.period_us));
  for (const bool in_the_link : {false, true}) {
    const std::uint32_t gaps[] = {1, hold_ticks, hold_ticks + 1, 10 * hold_ticks, 2'000'000};
    for (const std::uint32_t gap : gaps) {
      Bench& bench = relaxed_bench();
      bench.device.order(100);
      const std::uint8_t stand = 1;
      if (in_the_link) {
        const std::size_t size =
            dxl::encode_write(bench.frame, sizeof bench.frame, bench.id, reg("request"), &stand, 1);
        ASSERT_EQ(bench.wire.right().write(bench.frame, size, 0), size);
      } else {
        bench.write(reg("request"), stand);
      }
      const bool slept = gap > hold_ticks;
      const OperatorOrder order = bench.device.order(100 + gap);
      if (in_the_link && !slept) continue;
      EXPECT_EQ(order.flags, slept ? 0 : kCommandFresh) << gap;
      EXPECT_TRUE(order.command.request == (slept ? Request::kRelax : Request::kStand)) << gap;
      EXPECT_EQ(bench.value<std::uint8_t>(reg("request")), slept ? 0 : 1) << gap;
      EXPECT_EQ(bench.device.order(101 + gap).flags, 0);
      bench.write(reg("request"), stand);
      EXPECT_EQ(bench.device.order(102 + gap).flags, kCommandFresh) << "given anew it counts";
    }
  }
}

// A robot must not rise minutes later.
TEST(OperatorOrders, DoNotWaitForABringUp) {
  Bench& bench = relaxed_bench();
  bench.write(reg("request"), std::uint8_t{1});
  bench.device.brought_up({});
  const OperatorOrder order = bench.device.order(0);
  EXPECT_EQ(order.flags, 0);
  EXPECT_TRUE(order.command.request == Request::kRelax);
}

// A late loop must not make a robot with torque sit down.
TEST(OperatorOrders, OfARobotWithTorqueAndTheStopStandWhateverHappens) {
  Bench& bench = relaxed_bench();
  bench.device.order(0);
  bench.write(reg("request"), std::uint8_t{2});
  bench.write(reg("emergency_stop"), std::uint8_t{1});
  bench.arm(true);
  const OperatorOrder order = bench.device.order(100'000);
  EXPECT_EQ(order.flags, kEmergencyStop) << "not fresh";
  EXPECT_TRUE(order.command.request == Request::kWalk);
  bench.arm(false);
  EXPECT_EQ(bench.device.order(200'000).flags, kEmergencyStop);
}

TEST(OperatorOrders, ReadsTuningAndRefusedWritesAreNoOrders) {
  Bench& bench = fresh_bench();
  bench.read(reg("request"), 20);
  bench.write(reg("request"), std::uint8_t{9});
  bench.write(reg("status_return_level"), std::uint8_t{2});
  bench.write(reg("parameter_id"), std::uint16_t{1});
  EXPECT_EQ(bench.device.order(0).flags, 0);
}

TEST(OperatorOrders, TheEmergencyStopStaysPressed) {
  Bench& bench = fresh_bench();
  bench.write(reg("emergency_stop"), std::uint8_t{1});
  for (int i = 0; i < 3; ++i) EXPECT_TRUE((bench.device.order(0).flags & kEmergencyStop) != 0);
  bench.write(reg("emergency_stop"), std::uint8_t{0});
  EXPECT_EQ(bench.device.order(0).flags & kEmergencyStop, 0);
}

TEST(OperatorOrders, TheHeadTakesAnglesOrAPointWhileWalking) {
  Bench& bench = relaxed_bench();
  bench.write(reg("request"), std::uint8_t{2});
  const std::int16_t angles[] = {250, -100, 1000, 1000, 110};
  std::uint8_t bytes[sizeof angles];
  __builtin_memcpy(bytes, angles, sizeof angles);
  EXPECT_TRUE(bench.write_bytes(reg("head_pan"), bytes, sizeof bytes).error == Error::kNone);
  Command command = bench.device.order(0).command;
  EXPECT_EQ(command.head_pan_mrad, 250);
  EXPECT_EQ(command.head_tilt_mrad, -100);
  bench.write(reg("head_mode"), std::uint8_t{1});
  command = bench.device.order(1).command;
  EXPECT_TRUE(command.request == Request::kWalk);
  EXPECT_NEAR(command.head_pan_mrad, 785, 1);
  EXPECT_NEAR(command.head_tilt_mrad, 0, 1);
}

}  // namespace
}  // namespace verp::app::test
