#include <gtest/gtest.h>

#include <cmath>

#include "common/safety/machine.hpp"
#include "host/apps/tool/robot/run_operator.hpp"
#include "tests/support/gpio_pin.hpp"

// `verp run --take-orders`: the client decides.
namespace verp::tool {
namespace {

using safety::Mode;

class Obeying : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kPeriod_us = 10'000;
  static constexpr double kMost_s = 2;

  Obeying() {
    params.period_us = kPeriod_us;
    who.obey([this](std::uint32_t tick) {
      app::OperatorOrder order;
      order.command.request = ordered;
      order.command.sequence = static_cast<std::uint8_t>(tick);
      order.flags = kCommandFresh;
      return order;
    });
  }
  Request tick(Mode mode, std::uint32_t faults = 0) {
    const app::OperatorOrder order = who.order(ticks++);
    Outputs outputs;
    outputs.mode = static_cast<std::uint8_t>(mode);
    outputs.torque_enable = mode == Mode::kRelaxed ? 0 : 1;
    outputs.faults = faults;
    State state;
    state.attitude.up_body = {-std::sin(pitch_rad), 0, std::cos(pitch_rad)};
    who.observe(state, outputs);
    return order.command.request;
  }

  Params params;
  RunOperator who{params, {}, kMost_s, [](auto...) {}};
  Request ordered = Request::kStand;
  float pitch_rad = 0;
  std::uint32_t ticks = 0;
};

TEST_F(Obeying, PassesOnWhatIsOrderedUntilItsTimeIsOverThenSitsDown) {
  EXPECT_EQ(tick(Mode::kRising), Request::kStand);
  ordered = Request::kWalk;
  for (int i = 0; i < 150; ++i) EXPECT_EQ(tick(Mode::kWalking), Request::kWalk);
  EXPECT_NEAR(who.walked_s(), 1.5, 1e-9);
  for (int i = 0; i < 49; ++i) tick(Mode::kStanding);
  EXPECT_EQ(tick(Mode::kStanding), Request::kRelax) << "2 s are over, whatever is ordered";
  EXPECT_FALSE(who.over());
  for (int i = 0; i < 199; ++i) tick(Mode::kRelaxed);
  EXPECT_FALSE(who.over()) << "a crouch that tips over takes its time";
  for (int i = 0; i < 2; ++i) tick(Mode::kRelaxed);
  EXPECT_TRUE(who.over());
  EXPECT_EQ(who.failure(), "");
  EXPECT_EQ(who.ended(), "is upright");
}

TEST_F(Obeying, ThePressedButtonStopsItWhateverIsOrderedAndEndsTheRunByName) {
  test::GpioPin pin;
  link::StopLine stop(link::parse_stop("gpio:/dev/gpiochip0,17"), pin);
  who.stop_at(stop);
  EXPECT_EQ(who.order(ticks).flags & kEmergencyStop, 0);
  pin.grounded = false;
  who.order(ticks);
  EXPECT_NE(who.order(ticks).flags & kEmergencyStop, 0);
  tick(Mode::kStopped);
  EXPECT_EQ(who.failure(), "stopped by the button at gpio:/dev/gpiochip0,17");
  EXPECT_EQ(tick(Mode::kStopped), Request::kRelax) << "and is not raised again";
}

TEST_F(Obeying, ARobotThatWasOrderedToLetGoHasNotFailed) {
  tick(Mode::kStanding);
  ordered = Request::kRelax;
  for (int i = 0; i < 20; ++i) tick(Mode::kRelaxed);
  EXPECT_EQ(who.failure(), "");
  EXPECT_FALSE(who.over()) << "it may be ordered to stand again";
  ordered = Request::kStand;
  EXPECT_EQ(tick(Mode::kRising), Request::kStand);
}

TEST_F(Obeying, OneThatLetGoForAFaultHas) {
  tick(Mode::kStanding);
  tick(Mode::kRelaxed, 1);
  EXPECT_NE(who.failure(), "");
  EXPECT_EQ(tick(Mode::kRelaxed), Request::kRelax);
}

TEST_F(Obeying, OneThatFallsAfterItLetGoHas) {
  tick(Mode::kSitting);
  who.sit_down();
  for (int i = 0; i < 60; ++i) tick(Mode::kRelaxed);
  pitch_rad = -1.2F;
  tick(Mode::kRelaxed);
  EXPECT_NE(who.failure().find("0.6 s after torque went off it fell and lies on its back"),
            std::string::npos)
      << who.failure();
}

TEST_F(Obeying, OneThatLayBeforeItLetGoHasNot) {
  pitch_rad = 1.5F;
  tick(Mode::kLyingDown);
  who.sit_down();
  for (int i = 0; i < 210; ++i) tick(Mode::kRelaxed);
  EXPECT_TRUE(who.over());
  EXPECT_EQ(who.failure(), "");
  EXPECT_EQ(who.ended(), "lies on its front");
}

TEST_F(Obeying, OneThatLetGoAtOnceIsWatchedToo) {
  tick(Mode::kWalking);
  who.let_go();
  for (int i = 0; i < 150; ++i) tick(Mode::kRelaxed);
  EXPECT_FALSE(who.over()) << "it may be falling";
  pitch_rad = 1.5F;
  for (int i = 0; i < 60; ++i) tick(Mode::kRelaxed);
  EXPECT_TRUE(who.over());
  EXPECT_EQ(who.ended(), "lies on its front");
}

TEST_F(Obeying, WithASilentImuItSaysThatItDoesNotKnow) {
  tick(Mode::kSitting);
  who.sit_down();
  for (int i = 0; i < 210; ++i) tick(Mode::kRelaxed, safety::kFaultImuSilent);
  EXPECT_EQ(who.ended(), "not known: the IMU is silent");
}

TEST_F(Obeying, CtrlCGoesBeforeOrders) {
  ordered = Request::kWalk;
  tick(Mode::kWalking);
  who.sit_down();
  EXPECT_EQ(tick(Mode::kWalking), Request::kRelax);
}

}  // namespace
}  // namespace verp::tool
