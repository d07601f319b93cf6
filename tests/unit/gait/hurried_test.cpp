#include <gtest/gtest.h>

#include "common/gait/dcm.hpp"
#include "tests/unit/gait/walker.hpp"

namespace verp::gait {
namespace {

constexpr float kCycles_s[] = {0.30F, 0.45F, 0.70F};

test::Walker hurrying(float cycle_s) {
  test::Walker walker(test::kRobot);
  walker.tuning.gait.cycle_s = cycle_s;
  walker.set_off({});
  walker.in.at_once = true;
  walker.tick();
  return walker;
}

int ticks_to_swing(test::Walker& walker) {
  int ticks = 0;
  while (walker.state.queue[0].swing == kBoth && ticks < 1000) {
    walker.tick();
    ++ticks;
  }
  return ticks;
}

TEST(HurriedStart, SwingsAFootWithinATenthOfASecond) {
  test::Walker hurried = hurrying(0.45F);
  EXPECT_LE(ticks_to_swing(hurried), 10);
  test::Walker walk(test::kRobot);
  walk.set_off({});
  EXPECT_GE(ticks_to_swing(walk), 60) << "as a walk begins";
}

// One key point fewer would be outside.
TEST(HurriedStart, TheZmpStaysInsideTheSolesAndTheStartIsAsShortAsTheyAllow) {
  for (const float cycle_s : kCycles_s) {
    test::Walker walker = hurrying(cycle_s);
    walker.tick();
    const Step& step = walker.state.queue[0];
    const float reach_m = walker.tuning.gait.half_stance_m + test::kRobot.leg[kLeft].sole_left_m -
                          walker.tuning.gait.support_margin_m;
    EXPECT_LE(math::abs(step.zmp_end_m.y), reach_m) << cycle_s;
    EXPECT_LT(int{step.key_points}, kKeyPointsPerStep) << cycle_s;
    if (step.key_points == 3) continue;
    const float omega = walker.state.preview.omega;
    const float shorter_s = step.duration_s() - step.key_s();
    const float thrown_m = step.dcm_end_m.y / (1.0F - math::exp(omega * shorter_s));
    EXPECT_GT(math::abs(thrown_m), reach_m) << cycle_s;
  }
}

// The DCM begins over the middle of the soles.
TEST(HurriedStart, ThrowsThePendulumFromRestToWhereTheFirstStepWantsIt) {
  for (const float cycle_s : kCycles_s) {
    test::Walker walker = hurrying(cycle_s);
    const Xy rest_m = walker.state.preview.com_m;
    walker.tick();
    const float omega = walker.state.preview.omega;
    EXPECT_LT(test::apart(dcm_at(walker.state.queue[0], omega, 0.0F), rest_m), 1e-5F) << cycle_s;
    EXPECT_LT(
        test::apart(walker.state.queue[0].dcm_end_m, dcm_at(walker.state.queue[1], omega, 0.0F)),
        1e-5F)
        << cycle_s;
  }
}

TEST(HurriedStart, IsContinuousAndEndsOnBothFeet) {
  for (const std::int32_t period_us : {4000, 8000, 10000}) {
    test::Walker walker(test::kRobot, period_us);
    walker.set_off({});
    walker.in.at_once = true;
    const float period_s = 1e-6F * static_cast<float>(period_us);
    for (int tick = 0; static_cast<float>(tick) * period_s < 4.0F; ++tick) {
      if (static_cast<float>(tick) * period_s > 0.5F) walker.in.walk = false;
      const Pose before[] = {walker.sole(kLeft), walker.sole(kRight)};
      walker.tick();
      for (int side = 0; side < kFeet; ++side) {
        ASSERT_LT(test::distance(before[side].position_m, walker.sole(side).position_m),
                  0.5F * period_s)
            << period_us << " us, tick " << tick << ", foot " << side;
      }
    }
    EXPECT_EQ(int{walker.state.queued}, 0) << period_us;
  }
}

}  // namespace
}  // namespace verp::gait
