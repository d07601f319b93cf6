#include "common/math/spline.hpp"

#include <gtest/gtest.h>

namespace verp::math {
namespace {

/// Good to 1e-3 in float.
template <class Curve>
void expect_derivative(Curve curve) {
  constexpr float kStep = 1.0F / 256.0F;
  for (int i = 1; i < 32; ++i) {
    const float u = static_cast<float>(i) / 32.0F;
    const float slope = (curve(u + kStep).value - curve(u - kStep).value) / (2.0F * kStep);
    EXPECT_NEAR(curve(u).derivative, slope, 2e-3F) << u;
  }
}

TEST(MathSpline, HermiteMeetsItsEndsExactly) {
  const CurvePoint start = hermite(0.1F, 0.3F, -0.7F, 0.2F, 0.0F);
  const CurvePoint end = hermite(0.1F, 0.3F, -0.7F, 0.2F, 1.0F);
  EXPECT_EQ(start.value, 0.1F);
  EXPECT_EQ(end.value, -0.7F);
  EXPECT_NEAR(start.derivative, 0.3F, 1e-6F);
  EXPECT_NEAR(end.derivative, 0.2F, 1e-6F);
  expect_derivative([](float u) { return hermite(0.1F, 0.3F, -0.7F, 0.2F, u); });
}

TEST(MathSpline, HermiteReproducesACubic) {
  // p = 1 - 2u + 3u^2 - u^3
  for (int i = 0; i <= 16; ++i) {
    const float u = static_cast<float>(i) / 16.0F;
    EXPECT_NEAR(hermite(1.0F, -2.0F, 1.0F, 1.0F, u).value, 1.0F + u * (-2.0F + u * (3.0F - u)),
                1e-6F);
  }
}

TEST(MathSpline, MinimumJerkRestsAtBothEnds) {
  EXPECT_EQ(minimum_jerk(0.0F).value, 0.0F);
  EXPECT_EQ(minimum_jerk(1.0F).value, 1.0F);
  EXPECT_EQ(minimum_jerk(0.5F).value, 0.5F);
  EXPECT_EQ(minimum_jerk(0.0F).derivative, 0.0F);
  EXPECT_EQ(minimum_jerk(1.0F).derivative, 0.0F);
  EXPECT_EQ(minimum_jerk(0.5F).derivative, 1.875F);
  EXPECT_LT(minimum_jerk(0.01F).derivative, 0.01F);
  expect_derivative([](float u) { return minimum_jerk(u); });
  expect_derivative([](float u) { return minimum_jerk(0.2F, -0.4F, u); });
}

TEST(MathSpline, SmoothStepRestsAtBothEndsAndIsNeverFast) {
  EXPECT_EQ(smooth_step(0.0F).value, 0.0F);
  EXPECT_EQ(smooth_step(1.0F).value, 1.0F);
  EXPECT_EQ(smooth_step(0.0F).derivative, 0.0F);
  EXPECT_EQ(smooth_step(1.0F).derivative, 0.0F);
  EXPECT_EQ(smooth_step(0.5F).derivative, 1.5F);
  EXPECT_NEAR(smooth_step(0.25F).second, 3.0F, 1e-6F);
  expect_derivative([](float u) { return smooth_step(u); });
}

TEST(MathSpline, QuinticMeetsPositionsAndSlopes) {
  const auto curve = [](float u) { return quintic(0.1F, 0.3F, -0.7F, 0.2F, u); };
  EXPECT_EQ(curve(0.0F).value, 0.1F);
  EXPECT_EQ(curve(1.0F).value, -0.7F);
  EXPECT_NEAR(curve(0.0F).derivative, 0.3F, 1e-6F);
  EXPECT_NEAR(curve(1.0F).derivative, 0.2F, 1e-6F);
  EXPECT_NEAR(curve(1.0F / 64.0F).derivative, 0.3F, 1e-2F);
  expect_derivative(curve);
}

TEST(MathSpline, QuinticWithoutSlopesIsMinimumJerk) {
  for (int i = 0; i <= 16; ++i) {
    const float u = static_cast<float>(i) / 16.0F;
    EXPECT_NEAR(quintic(0.0F, 0.0F, 1.0F, 0.0F, u).value, minimum_jerk(u).value, 1e-6F);
  }
}

TEST(MathSpline, SwingLiftPassesLiftOffApexAndLanding) {
  EXPECT_EQ(swing_lift(0.0F).value, 0.0F);
  EXPECT_EQ(swing_lift(0.5F).value, 1.0F);
  EXPECT_EQ(swing_lift(1.0F).value, 0.0F);
  EXPECT_EQ(swing_lift(0.0F).derivative, 0.0F);
  EXPECT_EQ(swing_lift(0.5F).derivative, 0.0F);
  EXPECT_EQ(swing_lift(1.0F).derivative, 0.0F);
  EXPECT_EQ(swing_lift(0.25F).value, swing_lift(0.75F).value);
  expect_derivative([](float u) { return swing_lift(u); });
}

}  // namespace
}  // namespace verp::math
