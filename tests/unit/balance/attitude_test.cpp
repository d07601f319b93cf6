#include "common/balance/attitude.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/test_robot.hpp"

namespace verp::balance {
namespace {

constexpr float kG = math::kGravityMS2;
constexpr int kCalibrated_ticks = static_cast<int>(kCalibrated_s / 0.01F) + 2;

AttitudeIn still() {
  AttitudeIn in;
  in.fresh = true;
  in.accel_body_m_s2 = {0, 0, kG};
  in.standing = true;
  return in;
}

AttitudeOut run(AttitudeState& state, const AttitudeIn& in, int ticks) {
  AttitudeOut out;
  for (int i = 0; i < ticks; ++i) out = update(state, in);
  return out;
}

TEST(Attitude, StillRobotIsUpright) {
  AttitudeState state;
  const AttitudeOut out = run(state, still(), 100);
  EXPECT_NEAR(out.roll_rad, 0.0F, 1e-6F);
  EXPECT_NEAR(out.pitch_rad, 0.0F, 1e-6F);
  EXPECT_NEAR(out.heading_rad, 0.0F, 1e-6F);
  EXPECT_NEAR(out.up, 1.0F, 1e-6F);
}

// A MEMS gyro's bias is up to 5 deg/s; no tilt must come from it.
TEST(Attitude, BiasIsLearntWhileStanding) {
  AttitudeState state;
  AttitudeIn in = still();
  in.gyro_body_rad_s = {0.03F, -0.04F, 0.05F};
  EXPECT_FALSE(run(state, in, kCalibrated_ticks / 2).calibrated);
  const AttitudeOut out = run(state, in, kCalibrated_ticks);
  EXPECT_TRUE(out.calibrated);
  EXPECT_NEAR(state.gyro_bias_rad_s.x, 0.03F, 1e-4F);
  EXPECT_NEAR(state.gyro_bias_rad_s.y, -0.04F, 1e-4F);
  EXPECT_NEAR(state.gyro_bias_rad_s.z, 0.05F, 1e-4F);
  EXPECT_NEAR(out.roll_rad, 0.0F, 0.01F);
  EXPECT_NEAR(out.roll_rate_rad_s, 0.0F, 1e-3F);
}

// Steps accelerate the body in time with its sway. The accelerometer's tilt would turn the heading
// by 12 degrees in this minute.
TEST(Attitude, AccelerationsOfStepsHardlyTurnTheHeading) {
  constexpr float kStride_rad_s = 14.0F;
  AttitudeState state;
  run(state, still(), kCalibrated_ticks + 300);
  AttitudeIn in = still();
  in.standing = false;
  AttitudeOut out;
  for (int tick = 0; tick < 6000; ++tick) {
    const math::SinCos phase =
        math::sincos(math::wrap_angle(0.01F * kStride_rad_s * static_cast<float>(tick)));
    in.gyro_body_rad_s = {0, 0.5F * phase.cos, 0};
    in.accel_body_m_s2 = {0, 2.0F * phase.sin, kG};
    out = update(state, in);
  }
  EXPECT_LT(math::abs(out.heading_rad), 0.05F);
}

// After a rise, a body settles by some tenths of a degree.
TEST(Attitude, BiasIsNotLearntFromABodyThatSettles) {
  for (int when = 0; when < 30; when += 5) {
    AttitudeState state;
    for (int i = 0; i < kCalibrated_ticks; ++i) {
      AttitudeIn in = still();
      in.gyro_body_rad_s = {0, 0, i >= when && i < when + 5 ? 0.002F - 0.1F : 0.002F};
      update(state, in);
    }
    EXPECT_NEAR(state.gyro_bias_rad_s.z, 0.002F, 1e-5F) << "settles after tick " << when;
  }
}

// Creep: 0.02 rad, most of it in the first second, which the mean leaves out.
TEST(Attitude, BiasIsNotLearntFromServosThatCreep) {
  AttitudeState state;
  AttitudeIn in = still();
  float rate_rad_s = 0.05F;
  for (int tick = 0; tick < kCalibrated_ticks; ++tick) {
    in.gyro_body_rad_s = {0, 0, 0.01F + rate_rad_s};
    update(state, in);
    rate_rad_s *= 0.975F;
  }
  EXPECT_NEAR(state.gyro_bias_rad_s.z, 0.01F, 1e-3F);
}

TEST(Attitude, BiasIsNotLearntFromMotionNorWhileWalking) {
  AttitudeState state;
  AttitudeIn in = still();
  in.gyro_body_rad_s = {0.5F, 0, 0};
  EXPECT_FALSE(run(state, in, 2 * kCalibrated_ticks).calibrated);
  in.gyro_body_rad_s = {0.05F, 0, 0};
  in.standing = false;
  EXPECT_FALSE(run(state, in, 2 * kCalibrated_ticks).calibrated);
  EXPECT_EQ(state.gyro_bias_rad_s.x, 0.0F);
}

// Servos that hunt for their goals shake the body in place.
TEST(Attitude, TremblingDoesNotKeepTheBiasFromBeingLearnt) {
  for (const float frequency_hz : {5.0F, 8.0F, 13.0F, 37.0F}) {
    AttitudeState state;
    AttitudeOut out;
    for (int i = 0; i < kCalibrated_ticks; ++i) {
      const float phase = math::kTwoPi * frequency_hz * 0.01F * static_cast<float>(i);
      AttitudeIn in = still();
      in.gyro_body_rad_s = {0.05F + 0.18F * math::sin(phase), -0.06F + 0.18F * math::cos(phase), 0};
      out = update(state, in);
    }
    EXPECT_TRUE(out.calibrated) << frequency_hz << " Hz";
    EXPECT_NEAR(state.gyro_bias_rad_s.x, 0.05F, 0.005F) << frequency_hz << " Hz";
    EXPECT_NEAR(state.gyro_bias_rad_s.y, -0.06F, 0.005F) << frequency_hz << " Hz";
  }
}

TEST(Attitude, OneWrongReadingEndsNoCalibration) {
  for (int when = 0; when < kCalibrated_ticks; when += 7) {
    for (const float wrong : {0.15F, -2.0F, 35.0F}) {
      AttitudeState state;
      AttitudeOut out;
      for (int i = 0; i < kCalibrated_ticks; ++i) {
        AttitudeIn in = still();
        in.gyro_body_rad_s = {0.087F, i == when ? wrong : -0.087F, 0.087F};
        out = update(state, in);
      }
      EXPECT_TRUE(out.calibrated) << wrong << " rad/s at tick " << when;
      EXPECT_NEAR(state.gyro_bias_rad_s.y, -0.087F, 0.002F);
    }
  }
}

TEST(Attitude, BiasIsNotLearntFromARobotInSomebodysHands) {
  struct Motion {
    float rate_rad_s, frequency_hz;
  };
  for (const Motion& motion : {Motion{0.15F, 0.0F}, Motion{0.2F, 0.3F}, Motion{0.3F, 0.7F},
                               Motion{0.6F, 1.0F}, Motion{2.0F, 2.0F}}) {
    for (int axis = 0; axis < 3; ++axis) {
      AttitudeState state;
      for (int i = 0; i < 20 * kCalibrated_ticks; ++i) {
        const float time_s = 0.01F * static_cast<float>(i);
        AttitudeIn in = still();
        in.gyro_body_rad_s(axis) =
            motion.rate_rad_s * math::cos(math::kTwoPi * motion.frequency_hz * time_s);
        ASSERT_FALSE(update(state, in).calibrated)
            << motion.rate_rad_s << " rad/s at " << motion.frequency_hz << " Hz, tick " << i;
      }
    }
  }
}

TEST(Attitude, CalibrationSurvivesMotion) {
  AttitudeState state;
  run(state, still(), kCalibrated_ticks);
  AttitudeIn in = still();
  in.standing = false;
  in.gyro_body_rad_s = {1, 0, 0};
  EXPECT_TRUE(run(state, in, 20).calibrated);
}

// Half a second, with a matching accelerometer. Positive is right about x, nose down about y, left
// about z.
TEST(Attitude, ConstantRateIntegrates) {
  constexpr float kRate = 0.4F;
  for (int axis = 0; axis < 3; ++axis) {
    AttitudeState state;
    AttitudeOut out;
    for (int i = 1; i <= 50; ++i) {
      const float angle_rad = kRate * 0.01F * static_cast<float>(i);
      AttitudeIn in;
      in.fresh = true;
      in.gyro_body_rad_s(axis) = kRate;
      const Mat3 body = axis == 0   ? math::rot_x(angle_rad)
                        : axis == 1 ? math::rot_y(angle_rad)
                                    : math::rot_z(angle_rad);
      in.accel_body_m_s2 = body.transpose() * Vec3(0, 0, kG);
      out = update(state, in);
    }
    EXPECT_NEAR(out.roll_rad, axis == 0 ? 0.2F : 0.0F, 1e-3F);
    EXPECT_NEAR(out.pitch_rad, axis == 1 ? 0.2F : 0.0F, 1e-3F);
    EXPECT_NEAR(out.heading_rad, axis == 2 ? 0.2F : 0.0F, 1e-3F);
    EXPECT_NEAR(axis == 0 ? out.roll_rate_rad_s : out.pitch_rate_rad_s, axis < 2 ? kRate : 0.0F,
                1e-6F);
  }
}

// After 20 s of sway, pitch `lead_rad` ahead of roll.
float heading_after_sway(float lead_rad) {
  constexpr float kSway_rad = 0.03F;
  constexpr float kOmega = 14.0F;
  AttitudeState state;
  AttitudeOut out;
  for (int i = 0; i < 2000; ++i) {
    const float at_rad = kOmega * 0.01F * static_cast<float>(i);
    const math::SinCos phase = math::sincos(at_rad), ahead = math::sincos(at_rad + lead_rad);
    const float roll_rad = kSway_rad * phase.sin, pitch_rad = kSway_rad * ahead.sin;
    const float roll_rate = kSway_rad * kOmega * phase.cos;
    const float pitch_rate = kSway_rad * kOmega * ahead.cos;
    const math::SinCos roll = math::sincos(roll_rad);
    AttitudeIn in;
    in.fresh = true;
    in.gyro_body_rad_s = {roll_rate, pitch_rate * roll.cos, -pitch_rate * roll.sin};
    const Mat3 body = math::rot_y(pitch_rad) * math::rot_x(roll_rad);
    in.accel_body_m_s2 = body.transpose() * Vec3(0, 0, kG);
    out = update(state, in);
  }
  return out.heading_rad;
}

TEST(Attitude, SwayAboutTwoAxesDoesNotTurnTheHeading) {
  EXPECT_NEAR(heading_after_sway(0.5F * math::kPi), 0.0F, 0.01F)
      << "0.126 if the rate about the vertical is summed";
  EXPECT_NEAR(heading_after_sway(0.0F), 0.0F, 0.002F)
      << "0.009 if a tick's rate meets the \"up\" of its end";
}

TEST(Attitude, AccelerometerPullsAWrongTiltToTheVertical) {
  AttitudeState state;
  state.up_body = {0.3F, -0.2F, 0.93F};
  state.mean_s = kAccelTime_s;
  AttitudeIn in = still();
  in.standing = false;
  const AttitudeOut out = run(state, in, 800);
  EXPECT_NEAR(out.roll_rad, 0.0F, 1e-3F);
  EXPECT_NEAR(out.pitch_rad, 0.0F, 1e-3F);
}

TEST(Attitude, FirstReadingIsTheTilt) {
  for (const Vec3& up : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1)}) {
    AttitudeState state;
    AttitudeIn in = still();
    in.anew = true;
    in.accel_body_m_s2 = kG * up;
    EXPECT_NEAR(update(state, in).up, up.z(), 1e-6F);
    EXPECT_NEAR(math::norm(math::to_vec(state.up_body) - up), 0.0F, 1e-6F);
  }
}

// Later readings soon outvote the first, wrong ones.
TEST(Attitude, FirstReadingsOfABodyInMotionFade) {
  for (const Vec3& wrong : {Vec3(6, 0, 3), Vec3(0, -6, 3), Vec3(3, 3, -2), Vec3(0, 0, 0)}) {
    AttitudeState state;
    AttitudeIn in = still();
    in.anew = true;
    in.accel_body_m_s2 = wrong;
    update(state, in);
    in.anew = false;
    run(state, in, 4);
    EXPECT_GT(run(state, still(), 45).up, 0.94F) << "half a second later: less than 20 degrees";
    EXPECT_GT(run(state, still(), 200).up, 0.999F);
  }
}

TEST(Attitude, SwayOfAStepDoesNotTilt) {
  AttitudeState state;
  state.mean_s = kAccelTime_s;
  AttitudeOut out;
  for (int i = 0; i < 900; ++i) {
    AttitudeIn in;
    in.fresh = true;
    const float phase = math::kTwoPi * static_cast<float>(i) / 45;
    in.accel_body_m_s2 = {2.0F * math::sin(phase), 3.0F * math::cos(phase), kG};
    out = update(state, in);
    EXPECT_LT(math::abs(out.roll_rad) + math::abs(out.pitch_rad), 0.06F);
  }
}

TEST(Attitude, StaleSensorsHoldTheEstimate) {
  AttitudeState state;
  state.up_body = {0, 0.19866933F, 0.98006658F};
  AttitudeIn in;
  in.gyro_body_rad_s = {9, 9, 9};
  in.accel_body_m_s2 = {99, 99, 99};
  const AttitudeOut out = run(state, in, 100);
  EXPECT_NEAR(out.roll_rad, 0.2F, 1e-5F);
  EXPECT_EQ(out.roll_rate_rad_s, 0.0F);
  EXPECT_EQ(out.heading_rad, 0.0F);
}

TEST(Attitude, IsTotal) {
  test::Random random(1);
  AttitudeState state;
  for (int i = 0; i < 500; ++i) {
    AttitudeIn in;
    in.fresh = true;
    in.standing = random.bits() % 2 == 0;
    for (int k = 0; k < 3; ++k) {
      in.gyro_body_rad_s(k) = random.between(-40, 40);
      in.accel_body_m_s2(k) = random.between(-40, 40);
    }
    if (i % 7 == 0) in.accel_body_m_s2.setZero();
    const AttitudeOut out = update(state, in);
    ASSERT_TRUE(test::struct_is_finite(state));
    ASSERT_NEAR(math::norm(math::to_vec(state.up_body)), 1.0F, 1e-5F);
    ASSERT_LE(math::abs(out.heading_rad), math::kPi);
  }
}

}  // namespace
}  // namespace verp::balance
