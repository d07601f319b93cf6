#include <gtest/gtest.h>

#include "tests/unit/support/led_robot.hpp"

namespace verp::balance {
namespace {

using namespace verp::test;

constexpr float kOffset_m_s2 = 0.049F;  // 5 mg, 0.29 degrees

float lean_rad(const Led& led) {
  const Vec3 up = led.turned.transpose() * Vec3(0, 0, 1);
  return math::norm(math::cross(math::to_vec(led.state.up_body), up));
}

// The body's accelerations tilt the accelerometer's mean by half a degree.
TEST(Estimator, UpDoesNotLeanWithASwayingBody) {
  Led& led = led_robot();
  led.rest();
  float worst_rad = 0, worst_plain_rad = 0;
  for (int i = 0; i < 400; ++i) {
    const float phase = 2.0F * math::kPi * 2.0F * kPeriod_s * static_cast<float>(i);
    ASSERT_TRUE(led.tick(Vec3(0, 0.15F * math::sin(phase), 0)));
    const Xyz& plain = led.attitude.up_body;
    worst_plain_rad = math::max(worst_plain_rad, math::abs(math::atan2(plain.y, plain.z)));
    worst_rad = math::max(worst_rad, math::abs(roll_rad(led.state)));
  }
  EXPECT_GT(worst_plain_rad, 0.012F) << "the lean is there to be taken away";
  EXPECT_LT(worst_rad, 0.25F * worst_plain_rad);
}

// Standing reveals a quarter of an offset in any direction, less the encoders' resolution. The
// estimator keeps this while the robot walks.
TEST(EstimatorUp, AFloorStoodOnTakesAwayPartOfTheAccelerometersOffset) {
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(-0.6F, 0.8F, 0)}) {
    Led& led = led_robot();
    led.up_offset_m_s2 = kOffset_m_s2 * way;
    led.rest();
    EXPECT_NEAR(lean_rad(led), 0.005F, 3e-4F) << "nobody knows of it yet";
    led.in.standing = true;
    led.ticks(300);
    EXPECT_LT(lean_rad(led), 0.87F * 0.005F);
    EXPECT_GT(lean_rad(led), 0.6F * 0.005F) << "floors are not level either";
    led.in.standing = false;
    led.ground = math::rot_x(0.03F);
    led.ticks(100);
    EXPECT_LT(lean_rad(led), 0.87F * 0.005F) << "what is walked over tells nothing";
  }
}

TEST(EstimatorUp, ARampIsNotTakenForLevel) {
  for (const float slope_rad : {0.045F, 0.087F, -0.2F}) {
    Led& led = led_robot();
    led.ground = math::rot_y(slope_rad);
    led.in.standing = true;
    led.ticks(400);
    EXPECT_LT(lean_rad(led), 0.002F) << slope_rad;
  }
}

TEST(EstimatorUp, GoesOverFromFloorsToRampsSmoothly) {
  float before_rad = 0;
  for (int i = 0; i <= 50; ++i) {
    Led& led = led_robot();
    led.ground = math::rot_x(1e-3F * static_cast<float>(i));
    led.in.standing = true;
    led.ticks(20);
    const float lean = lean_rad(led);
    EXPECT_LT(math::abs(lean - before_rad), 1.2e-3F) << "slope of " << i << " mrad";
    EXPECT_LT(lean, 0.0045F) << "no floor leans it by more than a quarter of a degree";
    before_rad = lean;
  }
}

// The other sole may stand on a pebble.
TEST(EstimatorUp, OneSilentLegIsNoFloor) {
  Led& led = led_robot();
  led.up_offset_m_s2 = Vec3(kOffset_m_s2, 0, 0);
  led.in.standing = true;
  led.inputs.fresh = ~(1u << (kLeftLeg + 3));
  led.ticks(200);
  EXPECT_EQ(led.state.stood_s, 0.0F);
}

}  // namespace
}  // namespace verp::balance
