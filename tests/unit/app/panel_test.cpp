#include "firmware/app/panel.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/test_robot.hpp"

namespace verp::app {
namespace {

struct Orders {
  OperatorOrder order(std::uint32_t) { return next; }
  OperatorOrder next;
};
struct Pins {
  PanelReading read() { return now; }
  PanelReading now;
};

struct Bench {
  bool stopped() { return (panel.order(0).flags & kEmergencyStop) != 0; }
  Orders operator_link;
  Pins pins;
  WithPanel<Orders, Pins> panel{operator_link, pins, true};
};

TEST(Panel, StopsUntilTheCircuitWasReadClosedForAWhile) {
  Bench bench;
  EXPECT_TRUE(bench.stopped());
  int ticks = 1;
  for (; bench.stopped() && ticks < 1000; ++ticks) {
  }
  EXPECT_GT(ticks, 10);
  EXPECT_LT(ticks, 100);
}

TEST(Panel, WithoutAStopNothingIsAddedFromTheFirstTickOn) {
  Orders operator_link;
  Pins pins;
  WithPanel<Orders, Pins> panel(operator_link, pins, false);
  for (int tick = 0; tick < 100; ++tick) {
    const OperatorOrder order = panel.order(0);
    EXPECT_EQ(order.flags, 0);
    EXPECT_EQ(order.mailbox, 0);
  }
}

TEST(Panel, StopsWithinThreeTicksOfAnOpenCircuitAndStays) {
  Bench bench;
  for (int tick = 0; tick < 100; ++tick) bench.stopped();
  ASSERT_FALSE(bench.stopped());
  bench.pins.now.stop_pressed = true;
  bench.stopped();
  bench.stopped();
  for (int tick = 0; tick < 1000; ++tick) EXPECT_TRUE(bench.stopped());
}

// Until it is known, the stop counts as pressed. That must not cut the servos' power.
TEST(Panel, TellsAStopThatIsPressedFromOneThatIsNotYetKnown) {
  Bench closed;
  for (int tick = 0; tick < 1000; ++tick) {
    closed.stopped();
    EXPECT_FALSE(closed.panel.pressed()) << tick;
  }
  Bench open;
  open.pins.now.stop_pressed = true;
  for (int tick = 0; tick < 1000; ++tick) {
    EXPECT_TRUE(open.stopped());
    EXPECT_TRUE(open.panel.pressed()) << tick;
  }
}

TEST(Panel, ABouncingReleaseIsPressedUntilItIsReleased) {
  Bench bench;
  for (int tick = 0; tick < 100; ++tick) bench.stopped();
  bench.pins.now.stop_pressed = true;
  for (int tick = 0; tick < 100; ++tick) bench.stopped();
  ASSERT_TRUE(bench.panel.pressed());
  verp::test::Random random(2);
  for (int tick = 0; tick < 300; ++tick) {
    bench.pins.now.stop_pressed = tick % 16 == 0 || random.below(2) == 0;
    bench.stopped();
    EXPECT_TRUE(bench.panel.pressed());
  }
  bench.pins.now.stop_pressed = false;
  while (bench.stopped()) EXPECT_TRUE(bench.panel.pressed());
  EXPECT_FALSE(bench.panel.pressed());
}

TEST(Panel, TheStopOfTheOperatorsLinkIsAPressedOneToo) {
  Orders operator_link;
  operator_link.next.flags = kEmergencyStop;
  Pins pins;
  WithPanel<Orders, Pins> panel(operator_link, pins, false);
  panel.order(0);
  EXPECT_TRUE(panel.pressed());
  operator_link.next.flags = 0;
  panel.order(1);
  EXPECT_FALSE(panel.pressed());
}

TEST(Panel, BouncingNeverReleasesAndASparkNeverStops) {
  Bench bench;
  verp::test::Random random(1);
  for (int tick = 0; tick < 2000; ++tick) {
    bench.pins.now.stop_pressed = tick % 8 == 0 || random.below(3) == 0;
    EXPECT_TRUE(bench.stopped());
  }
  bench.pins.now.stop_pressed = false;
  for (int tick = 0; tick < 100; ++tick) bench.stopped();
  for (int tick = 0; tick < 1000; ++tick) {
    bench.pins.now.stop_pressed = tick % 2 == 0;
    EXPECT_FALSE(bench.stopped());
  }
}

TEST(Panel, LeavesTheOperatorsOrderAsItIs) {
  Bench bench;
  bench.operator_link.next.flags = kCommandFresh | kEmergencyStop;
  bench.operator_link.next.mailbox = 0x100;
  bench.operator_link.next.command.vx_tenth_mm_s = 7;
  for (int tick = 0; tick < 100; ++tick) bench.stopped();
  const OperatorOrder order = bench.panel.order(0);
  EXPECT_EQ(order.flags, kCommandFresh | kEmergencyStop) << "the operator's own stop counts too";
  EXPECT_EQ(order.mailbox, 0x100);
  EXPECT_EQ(order.command.vx_tenth_mm_s, 7);
}

TEST(Panel, ButtonsAreBitsOfTheMailbox) {
  Bench bench;
  for (int button = 0; button < kPanelButtons; ++button) {
    bench.pins.now.button_pressed[button] = true;
    for (int tick = 0; tick < 20; ++tick) bench.stopped();
    EXPECT_EQ(bench.panel.order(0).mailbox, 1 << button);
    bench.pins.now.button_pressed[button] = false;
    for (int tick = 0; tick < 20; ++tick) bench.stopped();
    EXPECT_EQ(bench.panel.order(0).mailbox, 0);
  }
}

}  // namespace
}  // namespace verp::app
