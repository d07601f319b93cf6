#include "common/gait/preview.hpp"

#include <gtest/gtest.h>

#include "tests/unit/gait/walker.hpp"

namespace verp::gait {
namespace {

using test::apart;
using test::Walker;

Xy last_miss(const PreviewState& preview) {
  return preview.ring[static_cast<std::uint8_t>(preview.head - 1) % kRing].zmp_miss_m;
}

// The robot is then the planned pendulum. Key points 15 ms apart resolve the ZMP's corners worst.
TEST(Preview, MasslessLegsLeaveNothingToCorrect) {
  static const Params robot = test::make_massless_legs_robot();
  Walker walker(robot);
  walker.tuning.gait.double_support = 0.5F;
  walker.tuning.gait.heading_gain = 0.0F;
  walker.set_off({.vx_m_s = 0.1F});
  walker.run(1.5F);  // the first jerk is too fast for key points
  float worst_m = 0;
  for (int i = 0; i < 400; ++i) {
    walker.tick();
    worst_m = math::max(
        worst_m, math::hypot(last_miss(walker.state.preview).x, last_miss(walker.state.preview).y));
  }
  EXPECT_LT(worst_m, 2e-3F);
  EXPECT_LT(apart(walker.state.preview.correction_m, {}), 5e-4F);
}

TEST(Preview, SwingingLegsAreCorrectedFor) {
  Walker walker(test::kRobot);
  walker.set_off({.vx_m_s = 0.1777F});
  walker.run(1.5F);
  float worst_m = 0;
  for (int i = 0; i < 400; ++i) {
    walker.tick();
    worst_m = math::max(worst_m, math::abs(last_miss(walker.state.preview).x));
  }
  EXPECT_GT(worst_m, 4e-3F);
  EXPECT_LT(worst_m, 5e-2F);
}

TEST(Preview, CorrectionCanBeSwitchedOff) {
  Walker walker(test::kRobot);
  walker.tuning.balance.multibody_enable = 0;
  walker.set_off({.vx_m_s = 0.1777F});
  for (int i = 0; i < 200; ++i) {
    walker.tick();
    EXPECT_EQ(apart(walker.state.preview.correction_m, {}), 0.0F);
  }
}

TEST(Preview, RebaseChangesNothingButTheOrigin) {
  Walker walker(test::kRobot);
  walker.set_off({.vx_m_s = 0.15F, .vy_m_s = 0.02F, .wz_rad_s = 0.2F});
  walker.run(2.0F);
  const Xy origin_m{0.12F, -0.05F};
  PreviewState here = walker.state.preview, there = walker.state.preview;
  rebase(origin_m, there);
  Step queue[kQueue];
  for (int i = 0; i < kQueue; ++i) {
    Step& step = queue[i] = walker.state.queue[i];
    for (Foothold& foot : step.foot) foot.at_m = foot.at_m - origin_m;
    step.landing.at_m = step.landing.at_m - origin_m;
    step.zmp_begin_m = step.zmp_begin_m - origin_m;
    step.zmp_end_m = step.zmp_end_m - origin_m;
    step.dcm_end_m = step.dcm_end_m - origin_m;
  }
  EXPECT_LT(apart(body_at(here, here.fixed, 0.0F), body_at(there, there.fixed, 0.0F) + origin_m),
            1e-6F);
  for (int i = 0; i < 8; ++i) {
    const Xy miss_here =
        lay_key_point(test::kRobot, walker.tuning, walker.state.queue, here).zmp_miss_m;
    const Xy miss_there = lay_key_point(test::kRobot, walker.tuning, queue, there).zmp_miss_m;
    EXPECT_LT(apart(miss_here, miss_there), 2e-4F) << "key point " << i;
    fix_key_point(walker.state.queue[0], here);
    fix_key_point(queue[0], there);
    EXPECT_LT(
        apart(here.fixed_m[here.fixed % kFixed], there.fixed_m[there.fixed % kFixed] + origin_m),
        2e-5F)
        << "key point " << i;
  }
}

TEST(Preview, BodyCurveMeetsItsKeyPointsSmoothly) {
  PreviewState state;
  test::Random random(1);
  for (Xy& fixed : state.fixed_m)
    fixed = {random.between(-0.1F, 0.1F), random.between(-0.1F, 0.1F)};
  for (std::uint8_t key = 250; key != 10; key = static_cast<std::uint8_t>(key + 1)) {
    EXPECT_EQ(apart(body_at(state, key, 0.0F), state.fixed_m[key % kFixed]), 0.0F);
    const auto before = static_cast<std::uint8_t>(key - 1);
    EXPECT_LT(apart(body_at(state, before, 1.0F), state.fixed_m[key % kFixed]), 1e-6F);
    const Xy slope_before = body_at(state, before, 1.0F) - body_at(state, before, 0.999F);
    const Xy slope_after = body_at(state, key, 0.001F) - body_at(state, key, 0.0F);
    EXPECT_LT(apart(slope_before, slope_after), 5e-6F) << int{key};
  }
}

TEST(Preview, StandingBodyHasNoAcceleration) {
  PreviewState state;
  for (Xy& fixed : state.fixed_m) fixed = {0.01F, 0.02F};
  EXPECT_EQ(apart(body_acceleration(state, 5, 0.3F, 0.015F), {}), 0.0F);
  for (int i = 0; i < kFixed; ++i) {  // x = t^2 / 2
    state.fixed_m[i] = {0.5F * static_cast<float>(i * i), 0};
  }
  EXPECT_NEAR(body_acceleration(state, 5, 0.3F, 1.0F).x, 1.0F, 1e-5F);
}

}  // namespace
}  // namespace verp::gait
