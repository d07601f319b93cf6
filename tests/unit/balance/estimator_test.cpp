#include <gtest/gtest.h>

#include "tests/unit/support/led_robot.hpp"

namespace verp::balance {
namespace {

using namespace verp::test;

TEST(Estimator, CentreOfMassOfAStillRobotIsThatOfItsLinks) {
  Led& led = led_robot();
  led.turned = math::rot_y(0.1F) * math::rot_x(-0.05F);
  led.ticks(300);
  float angle_rad[kMaxJoints] = {};
  for (int j = kLeftLeg; j < kJointCount; ++j) {
    angle_rad[j] = model::angle_of(led.params.joint[j], led.inputs.position_count[j]);
  }
  const Vec3 com = kinematics::center_of_mass(led.params, Pose{led.turned, led.body_m}, angle_rad);
  EXPECT_LT(distance(com_m(led.state), com), 1e-3F);
  EXPECT_LT(math::norm(math::to_vec(led.state.com_velocity_m_s)), 1e-3F);
  EXPECT_NEAR(led.state.body_m.z, kStandHeight_m, 1e-3F) << "over its soles";
  const gait::Xy dcm = dcm_m(led.state);
  EXPECT_NEAR(dcm.x, com.x(), 1e-3F) << "at rest the DCM is the centre of mass";
  EXPECT_NEAR(dcm.y, com.y(), 1e-3F);
}

TEST(Estimator, FollowsASwayWithoutLag) {
  constexpr float kMost_m_s = 0.15F, kPulse_per_s = 2.0F * math::kPi * 2.0F;
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 0.3F)}) {
    Led& led = led_robot();
    led.rest();
    float worst_m_s = 0, worst_m = 0;
    for (int i = 0; i < 300; ++i) {
      const float phase = kPulse_per_s * kPeriod_s * static_cast<float>(i);
      ASSERT_TRUE(led.tick(kMost_m_s * math::sin(phase) * way));
      if (i < 100) continue;
      worst_m_s = math::max(worst_m_s, distance(led.believed_m_s(), led.velocity_m_s));
      worst_m = math::max(worst_m, distance(led.believed_m(), led.body_m));
    }
    EXPECT_LT(worst_m_s, 0.015F) << "a tenth of it";
    EXPECT_LT(worst_m, 1.5e-3F);
  }
}

// The higher the body, the more its believed velocity turns "up", which moves the soles.
TEST(Estimator, ATallRobotThatWasPushedComesToRest) {
  Led& led = led_robot();
  led.grow(4.0F);
  led.rest();
  led.ticks(10, Vec3(0.1F, 0.1F, 0));
  led.ticks(200);
  EXPECT_LT(math::norm(led.believed_m_s()), 0.01F);
  EXPECT_LT(distance(led.believed_m(), led.body_m), 0.01F);
}

// The velocity error is 2 * offset / rate, where `rate` is that at which the legs are believed: 5.6
// mm/s for 5 mg at 18 per second.
TEST(Estimator, OffsetOfTheAccelerometerIsNoDrift) {
  Led& led = led_robot();
  led.rest();
  led.accel_offset_m_s2 = Vec3(0.05F, 0, 0);
  led.ticks(500);
  EXPECT_GT(led.believed_m_s().x(), 0.003F) << "it is felt";
  EXPECT_LT(led.believed_m_s().x(), 0.007F);
  EXPECT_LT(distance(led.believed_m(), led.body_m), 1e-3F);
}

TEST(Estimator, TouchdownsNeitherJumpNorCreep) {
  Led& led = led_robot();
  led.rest();
  const Vec3 speed(0.1F, 0, 0);
  Vec3 before = led.believed_m();
  float longest_m = 0;
  constexpr int kStep_ticks = 25;
  for (int i = 0; i < 12 * kStep_ticks; ++i) {
    const int step = i / kStep_ticks, swing = step % 2;
    const float part = static_cast<float>(i % kStep_ticks + 1) / kStep_ticks;
    led.sole_m[swing].x() = led.body_m.x() - 0.02F + 0.035F * part;
    led.sole_m[swing].z() = 0.02F * math::sin(math::kPi * part);
    led.stand_on(swing == 0 ? 0.0F : 1.0F);
    if (i % kStep_ticks >= kStep_ticks - 2) led.stand_on(0.5F);
    if (i % kStep_ticks >= kStep_ticks - 2) led.sole_m[swing].z() = 0;
    if (i % kStep_ticks == kStep_ticks - 1) led.sole_m[swing].x() = led.body_m.x() + 0.015F;
    ASSERT_TRUE(led.tick(speed)) << i;
    longest_m = math::max(longest_m, distance(led.believed_m(), before));
    before = led.believed_m();
  }
  EXPECT_LT(longest_m, 2.5e-3F) << "a tick's way is a millimetre";
  EXPECT_LT(distance(led.believed_m_s(), speed), 0.03F);
  EXPECT_NEAR(led.state.body_m.x, led.body_m.x(), 0.15F * led.body_m.x());
  EXPECT_NEAR(led.state.body_m.y, 0.0F, 5e-3F);
}

TEST(Estimator, SilentSolesAreReplacedByThePlan) {
  Led& led = led_robot();
  led.rest();
  led.inputs.flags = kImuFresh;
  led.load_n[0] = led.load_n[1] = 0;
  led.in.carrying = gait::kLeft;
  float fastest_m_s = 0;
  for (int i = 0; i < 60; ++i) {
    ASSERT_TRUE(led.tick(Vec3(0, 0, 0)));
    fastest_m_s = math::max(fastest_m_s, math::norm(led.believed_m_s()));
  }
  EXPECT_LT(fastest_m_s, 5e-3F);
  EXPECT_NEAR(led.state.left, 1.0F, 0.01F);
  led.in.on_feet = false;
  led.ticks(1);
  EXPECT_GT(led.state.blind, 0) << "the plan does not stand";
}

TEST(Estimator, LiftedRobotComesToRest) {
  Led& led = led_robot();
  led.rest();
  led.ticks(20, Vec3(0.1F, 0, 0));
  led.load_n[0] = led.load_n[1] = 0;
  const Vec3 at_m = led.believed_m();
  for (int i = 0; i < 300; ++i) {
    led.sole_m[i % 2].x() += 1e-3F;
    led.tick(Vec3(0, 0, 0));
  }
  EXPECT_LT(math::norm(led.believed_m_s()), 1e-3F);
  EXPECT_LT(distance(led.believed_m(), at_m), 0.05F);
}

TEST(Estimator, SilentJointsNeitherStopNorThrowIt) {
  Led& led = led_robot();
  const Vec3 speed(0.05F, 0, 0);
  led.rest();
  led.ticks(60, speed);
  float worst_m_s = 0;
  for (int i = 0; i < 60; ++i) {
    const bool silent = i >= 20 && i < 26;
    led.inputs.fresh = silent ? ~(1u << (kLeftLeg + 3)) : ~0u;
    led.tick(speed);
    worst_m_s = math::max(worst_m_s, distance(led.believed_m_s(), speed));
  }
  EXPECT_LT(worst_m_s, 0.03F);
  EXPECT_NEAR(led.state.body_m.x, led.body_m.x(), 4e-3F);
  led.inputs.fresh = 0;
  led.ticks(200, Vec3(0, 0, 0));
  EXPECT_LT(math::norm(led.believed_m_s()), 1e-3F) << "nobody knows of any motion";
  EXPECT_TRUE(struct_is_finite(led.state));
}

TEST(Estimator, AnyInputsLeaveItFinite) {
  Led& led = led_robot();
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    for (std::int32_t& count : led.inputs.position_count) {
      count = static_cast<std::int32_t>(random.bits());
    }
    led.inputs.fresh = random.bits();
    led.inputs.flags = static_cast<std::uint16_t>(random.bits() & 3u);
    for (auto& foot : led.inputs.foot_count) {
      for (std::uint16_t& count : foot) count = static_cast<std::uint16_t>(random.bits());
    }
    led.in.imu_fresh = random.below(2) == 0;
    led.in.carrying = random.bits() % 3;
    led.in.on_feet = random.below(2) == 0;
    led.in.accel_body_m_s2 = {random.between(-300, 300), random.between(-300, 300),
                              random.between(-300, 300)};
    led.in.gyro_body_rad_s = {random.between(-40, 40), random.between(-40, 40),
                              random.between(-40, 40)};
    led.attitude.up_body = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    led.attitude.heading_rad = random.between(-math::kPi, math::kPi);
    update(led.params, led.state, led.in);
    ASSERT_TRUE(struct_is_finite(led.state)) << i;
    ASSERT_LT(math::norm(led.believed_m_s()), 20.0F);
    const gait::Xy dcm = dcm_m(led.state);
    ASSERT_TRUE(math::is_finite(dcm.x) && math::is_finite(dcm.y));
  }
}

TEST(Estimator, IsTheSameToBothSides) {
  Vec3 one_sided[2];
  for (int mirror = 0; mirror < 2; ++mirror) {
    Led& led = led_robot();
    const float sign = mirror == 0 ? 1.0F : -1.0F;
    led.stand_on(mirror == 0 ? 0.8F : 0.2F);
    for (int i = 0; i < 80; ++i) {
      ASSERT_TRUE(led.tick(Vec3(0.02F, sign * 0.1F * math::sin(0.1F * static_cast<float>(i)), 0)));
    }
    one_sided[mirror] = led.believed_m();
  }
  EXPECT_LT(distance(one_sided[0], mirrored(one_sided[1])), 1e-3F);
}

TEST(Estimator, KnowsNothingOfARobotWithoutLegs) {
  Led& led = led_robot();
  for (LegParams& leg : led.params.leg) leg.solver = LegSolver::kNone;
  update(led.params, led.state, led.in);
  EXPECT_EQ(led.state.begun, 0);
  EXPECT_EQ(led.state.body_m.z, 0.0F);
}

// Blindness of ten ticks is bridged; then it slows by a tenth in each.
TEST(Estimator, LiftedItFollowsTheAccelerometerForTenTicksWhicheverWayItLooks) {
  const Vec3 gain_m_s(0.02F, -0.01F, 0.01F);
  for (const float heading_rad : {0.0F, 1.1F, -2.5F}) {
    Led& led = led_robot();
    led.attitude.heading_rad = heading_rad;
    led.rest();
    led.load_n[0] = led.load_n[1] = 0;
    float gains = 0;
    for (int tick = 1; tick <= 20; ++tick) {
      led.in.imu_fresh = tick != 4;
      led.tick(static_cast<float>(tick) * gain_m_s);
      gains = tick > 10 ? 0.9F * gains : tick == 4 ? gains : gains + 1.0F;
      const Vec3 expected_m_s = math::rot_z(heading_rad) * (gains * gain_m_s);
      EXPECT_LT(distance(led.believed_m_s(), expected_m_s), 0.01F) << tick;
    }
  }
}

TEST(Estimator, OneLegThatReportsTellsTheWholeWay) {
  for (int side = 0; side < kFeet; ++side) {
    Led& led = led_robot();
    led.rest();
    led.inputs.fresh = ~(1u << led.params.leg[side].joint[3]);
    led.ticks(40, Vec3(0.1F, 0, 0));
    EXPECT_NEAR(led.state.body_m.x, 0.0395F, 1.5e-3F);
    led.stand_on(side == 0 ? 0.85F : 0.15F);
    led.ticks(1, Vec3(0.1F, 0, 0));
    EXPECT_EQ(led.state.blind, 1) << "a leg that bears less than a fifth tells nothing";
  }
}

}  // namespace
}  // namespace verp::balance
