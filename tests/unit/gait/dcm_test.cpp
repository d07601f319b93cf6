#include "common/gait/dcm.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/test_robot.hpp"

namespace verp::gait {
namespace {

using test::Random;

constexpr float kOmega = 7.2F;  // a CoM 0.19 m high

float apart(Xy a, Xy b) {
  return math::hypot(a.x - b.x, a.y - b.y);
}

Step step_to(Xy zmp_begin_m, Xy zmp_end_m, float double_support_s) {
  Step step;
  step.key_us = 15000;
  step.key_points = 15;
  step.swing = kLeft;
  step.double_support_s = double_support_s;
  step.zmp_begin_m = zmp_begin_m;
  step.zmp_end_m = zmp_end_m;
  return step;
}

// Steps of 4 cm; the last DCM as if walking continued.
void lay_walk(Step* steps, int count, float double_support_s) {
  Xy from_m{0, 0};
  for (int i = 0; i < count; ++i) {
    const Xy to_m{0.04F * static_cast<float>(i), i % 2 == 0 ? -0.04F : 0.04F};
    steps[i] = step_to(from_m, to_m, double_support_s);
    from_m = to_m;
  }
  const float side = count % 2 == 0 ? -0.08F : 0.08F;
  steps[count - 1].dcm_end_m =
      periodic_dcm(steps[count - 1], {0.04F, side}, {0.04F, -side}, kOmega);
  for (int i = count - 2; i >= 0; --i) steps[i].dcm_end_m = dcm_at(steps[i + 1], kOmega, 0.0F);
}

TEST(Dcm, ZmpMovesDuringDoubleSupportThenRests) {
  const Step step = step_to({0, 0.1F}, {0.2F, 0}, 0.1F);
  EXPECT_EQ(apart(zmp_at(step, -1), step.zmp_begin_m), 0.0F);
  EXPECT_EQ(apart(zmp_at(step, 0), step.zmp_begin_m), 0.0F);
  EXPECT_LT(apart(zmp_at(step, 0.05F), {0.1F, 0.05F}), 1e-6F);
  EXPECT_EQ(apart(zmp_at(step, 0.1F), step.zmp_end_m), 0.0F);
  EXPECT_EQ(apart(zmp_at(step, 9), step.zmp_end_m), 0.0F);
}

TEST(Dcm, EndsAStepWhereThePlanSays) {
  for (const float support_s : {0.0F, 0.01F, 0.1F, 0.225F}) {
    Step step = step_to({0, 0}, {0.02F, -0.04F}, support_s);
    step.dcm_end_m = {0.05F, -0.01F};
    EXPECT_LT(apart(dcm_at(step, kOmega, step.duration_s()), step.dcm_end_m), 1e-6F);
  }
}

// Forward integration would diverge.
TEST(Dcm, ComStaysBoundedOverALongWalk) {
  Step steps[40];
  for (const float support_s : {0.0F, 0.011F, 0.1F}) {
    lay_walk(steps, 40, support_s);
    Xy com_m{0, 0};
    for (const Step& step : steps) {
      com_m = com_after(step, kOmega, com_m, 0.0F, step.duration_s());
      EXPECT_LT(apart(com_m, step.zmp_end_m), 0.12F);
      EXPECT_LT(math::abs(com_m.y), 0.03F) << "sways between the feet";
    }
    EXPECT_NEAR(com_m.x, steps[39].zmp_end_m.x, 0.03F);
  }
}

TEST(Dcm, ContinuesFromStepToStep) {
  Step steps[6];
  lay_walk(steps, 6, 0.05F);
  for (int i = 0; i + 1 < 6; ++i) {
    EXPECT_LT(
        apart(dcm_at(steps[i], kOmega, steps[i].duration_s()), dcm_at(steps[i + 1], kOmega, 0.0F)),
        1e-6F);
  }
}

// x' = omega (xi - x), xi' = omega (xi - zmp), steps of 0.1 ms, midpoint rule.
TEST(Dcm, ClosedFormMatchesNumericIntegration) {
  Step steps[3];
  for (const float support_s : {0.0F, 0.02F, 0.1F}) {
    lay_walk(steps, 3, support_s);
    const Step& step = steps[1];
    const Xy start_m{0.01F, -0.02F};
    constexpr float kStep_s = 1e-4F;
    Xy com_m = start_m;
    for (int i = 0; i < 2250; ++i) {
      const float middle_s = (static_cast<float>(i) + 0.5F) * kStep_s;
      const Xy dcm_m = dcm_at(step, kOmega, middle_s);
      const Xy half_m = com_m + (0.5F * kStep_s * kOmega) * (dcm_m - com_m);
      com_m = com_m + (kStep_s * kOmega) * (dcm_m - half_m);
    }
    EXPECT_LT(apart(com_after(step, kOmega, start_m, 0.0F, 0.225F), com_m), 2e-5F) << support_s;
  }
}

TEST(Dcm, TwoStretchesMakeTheWhole) {
  Step steps[3];
  lay_walk(steps, 3, 0.05F);
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Xy start_m{random.between(-0.05F, 0.05F), random.between(-0.05F, 0.05F)};
    const float middle_s = random.between(0.0F, 0.225F);
    const Xy middle_m = com_after(steps[1], kOmega, start_m, 0.0F, middle_s);
    EXPECT_LT(apart(com_after(steps[1], kOmega, middle_m, middle_s, 0.225F),
                    com_after(steps[1], kOmega, start_m, 0.0F, 0.225F)),
              1e-6F);
  }
}

TEST(Dcm, PeriodicEndIsAFixedPointOfTwoSteps) {
  for (const float support_s : {0.0F, 0.011F, 0.1F, 0.2F}) {
    const Xy one_m{0.04F, 0.08F}, other_m{0.03F, -0.07F};
    Step last = step_to({0, 0}, {0.01F, 0.02F}, support_s);
    last.dcm_end_m = periodic_dcm(last, one_m, other_m, kOmega);
    Step next = step_to(last.zmp_end_m, last.zmp_end_m + one_m, support_s);
    next.dcm_end_m = periodic_dcm(next, other_m, one_m, kOmega);
    Step second = step_to(next.zmp_end_m, next.zmp_end_m + other_m, support_s);
    second.dcm_end_m = periodic_dcm(second, one_m, other_m, kOmega);
    EXPECT_LT(apart(dcm_at(next, kOmega, 0.0F), last.dcm_end_m), 1e-6F) << support_s;
    EXPECT_LT(apart(dcm_at(second, kOmega, 0.0F), next.dcm_end_m), 1e-6F) << support_s;
  }
}

TEST(Dcm, StandingOnOneSpotStaysThere) {
  Step step = step_to({0.01F, 0.02F}, {0.01F, 0.02F}, 0.225F);
  step.dcm_end_m = step.zmp_end_m;
  EXPECT_LT(apart(com_after(step, kOmega, step.zmp_end_m, 0.0F, 0.225F), step.zmp_end_m), 1e-7F);
}

}  // namespace
}  // namespace verp::gait
