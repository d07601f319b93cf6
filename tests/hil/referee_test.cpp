#include <gtest/gtest.h>

#include "common/model/counts.hpp"
#include "tests/hil/modes.hpp"
#include "tests/hil/safe_table.hpp"
#include "tests/unit/support/test_robot.hpp"

// A controller may walk only if asked to or pushed.
namespace verp::test {
namespace {

// In mid-range, asked to stand.
struct Controller {
  Controller() {
    inputs.flags = kImuFresh | kFeetFresh | kCommandFresh;
    inputs.fresh = ~0U;
    inputs.accel_count[2] = 8172;
    inputs.command.request = Request::kStand;
    for (int j = 0; j < kRobot.joint_count; ++j) {
      const JointParams& joint = kRobot.joint[j];
      inputs.position_count[j] = model::count_of(joint, 0.5F * (joint.lower_rad + joint.upper_rad));
      outputs.goal_count[j] = inputs.position_count[j];
    }
    is(kRelaxed, 1);
    is(kRising, 2);
    is(kStanding, 1);
  }
  void is(Mode mode, double for_s) {
    outputs.mode = mode;
    outputs.torque_enable = mode == kRelaxed ? 0 : (1U << kRobot.joint_count) - 1;
    for (int i = 0; i < for_s / 0.01; ++i) {
      inputs.accel_count[2] ^= 1;  // a live chip has noise
      referee.tick(inputs, outputs);
      ++inputs.tick;
    }
  }
  void is_pushed() {
    inputs.gyro_count[1] = static_cast<std::int16_t>(0.5F / kRobot.imu.gyro_rad_s_per_count);
    is(kStanding, 0.05);
    inputs.gyro_count[1] = 0;
  }
  bool saw(const char* what) const { return referee.violation().find(what) != std::string::npos; }

  SafeTable referee{kRobot};
  Inputs inputs;
  Outputs outputs;
};

TEST(Referee, HasNothingAgainstARobotThatStandsAsAsked) {
  EXPECT_EQ(Controller().referee.violation(), "");
}

TEST(Referee, SeesAWalkThatNobodyAskedForNorPushed) {
  Controller controller;
  controller.is(kWalking, 0.1);
  EXPECT_TRUE(controller.saw("walked unasked")) << controller.referee.violation();
}

TEST(Referee, LetsAPushedRobotStepForAShortWhileAfterThePush) {
  Controller soon;
  soon.is_pushed();
  soon.is(kStanding, 0.1);
  soon.is(kWalking, 0.1);
  EXPECT_EQ(soon.referee.violation(), "");
  Controller late;
  late.is_pushed();
  late.is(kStanding, 0.4);
  late.is(kWalking, 0.1);
  EXPECT_TRUE(late.saw("walked unasked")) << late.referee.violation();
}

TEST(Referee, SeesARobotStepThatIsToRelaxOrThatNobodyWatches) {
  Controller relaxing;
  relaxing.is_pushed();
  relaxing.inputs.command.request = Request::kRelax;
  relaxing.is(kWalking, 0.1);
  EXPECT_TRUE(relaxing.saw("walked unasked")) << relaxing.referee.violation();
  Controller alone;
  alone.inputs.flags &= static_cast<std::uint16_t>(~kCommandFresh);
  alone.is(kStanding, 0.6);
  alone.is_pushed();
  alone.is(kWalking, 0.1);
  EXPECT_TRUE(alone.saw("nobody watching")) << alone.referee.violation();
}

TEST(Referee, SeesARobotThatRisesAfterTheFifthSilenceInARow) {
  Controller controller;
  const auto hold_and_rise = [&controller](Mode from) {
    controller.inputs.fresh = ~1U;
    controller.is(from, 0.04);
    controller.is(kHolding, 0.03);
    controller.inputs.fresh = ~0U;
    controller.is(kRising, 0.2);
  };
  hold_and_rise(kStanding);
  for (int i = 1; i < 4; ++i) hold_and_rise(kRising);
  EXPECT_EQ(controller.referee.violation(), "");
  hold_and_rise(kRising);
  EXPECT_TRUE(controller.saw("in trouble")) << controller.referee.violation();
}

TEST(Referee, SeesARobotThatWalksOnWithNobodyWatching) {
  Controller controller;
  controller.inputs.command.request = Request::kWalk;
  controller.is(kWalking, 1);
  controller.inputs.flags &= static_cast<std::uint16_t>(~kCommandFresh);
  controller.is(kWalking, 1.5);
  EXPECT_EQ(controller.referee.violation(), "");
  controller.is(kWalking, 1.5);
  EXPECT_TRUE(controller.saw("walks on")) << controller.referee.violation();
}

}  // namespace
}  // namespace verp::test
