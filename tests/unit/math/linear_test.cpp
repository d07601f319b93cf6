#include "common/math/linear.hpp"

#include <gtest/gtest.h>

namespace verp::math {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

template <class A, class B>
float difference(const A& a, const B& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

TEST(MathLinear, RotationsTurnByTheRightHand) {
  EXPECT_LT(difference(rot_x(kHalfPi) * Vec3::UnitY(), Vec3::UnitZ()), 1e-7F);
  EXPECT_LT(difference(rot_y(kHalfPi) * Vec3::UnitZ(), Vec3::UnitX()), 1e-7F);
  EXPECT_LT(difference(rot_z(kHalfPi) * Vec3::UnitX(), Vec3::UnitY()), 1e-7F);
}

TEST(MathLinear, AxisRotationAgreesWithTheFrameAxes) {
  for (int i = -8; i <= 8; ++i) {
    const float angle = static_cast<float>(i) * 0.4F;
    EXPECT_LT(difference(rotation(Vec3::UnitX(), angle), rot_x(angle)), 1e-7F);
    EXPECT_LT(difference(rotation(Vec3::UnitY(), angle), rot_y(angle)), 1e-7F);
    EXPECT_LT(difference(rotation(Vec3::UnitZ(), angle), rot_z(angle)), 1e-7F);
    EXPECT_LT(difference(rotation(-Vec3::UnitZ(), angle), rot_z(-angle)), 1e-7F);
  }
}

TEST(MathLinear, AxisRotationIsOrthonormalAndKeepsItsAxis) {
  const Vec3 axis = normalized_or(Vec3(1.0F, -2.0F, 0.5F), Vec3::UnitX());
  const Mat3 r = rotation(axis, 2.3F);
  EXPECT_LT(difference(r * r.transpose(), Mat3::Identity()), 5e-7F);
  EXPECT_LT(difference(r * axis, axis), 3e-7F);
}

TEST(MathLinear, RollPitchYawIsUndone) {
  for (int i = -7; i <= 7; ++i) {
    for (int j = -7; j <= 7; ++j) {
      const Vec3 rpy(static_cast<float>(i) * 0.4F, static_cast<float>(j) * 0.22F,
                     static_cast<float>(i - j) * 0.2F);
      const Mat3 r = rotation_rpy(rpy.x(), rpy.y(), rpy.z());
      ASSERT_LT(difference(r, rot_z(rpy.z()) * rot_y(rpy.y()) * rot_x(rpy.x())), 3e-7F);
      ASSERT_LT(difference(roll_pitch_yaw(r), rpy), 5e-6F) << i << " " << j;
    }
  }
}

TEST(MathLinear, RollPitchYawAtGimbalLockStillGivesTheRotation) {
  const Mat3 r = rotation_rpy(0.3F, kHalfPi, -0.5F);
  const Vec3 rpy = roll_pitch_yaw(r);
  EXPECT_LT(difference(rotation_rpy(rpy.x(), rpy.y(), rpy.z()), r), 1e-6F);
}

TEST(MathLinear, RotationVectorIsAxisTimesAngle) {
  const Vec3 axis = normalized_or(Vec3(-0.3F, 0.8F, 0.5F), Vec3::UnitX());
  const float angles[] = {0.0F, 1e-6F, 1e-4F, 0.01F, 1.0F, 2.0F, 2.8F, 3.0F, 3.1F, 3.1415F};
  for (const float angle : angles) {
    EXPECT_LT(difference(rotation_vector(rotation(axis, angle)), axis * angle), 2e-6F) << angle;
  }
  const Vec3 half_turn = rotation_vector(rot_y(kPi));
  EXPECT_LT(difference(half_turn.cwiseAbs(), Vec3(0.0F, kPi, 0.0F)), 1e-6F);
  EXPECT_TRUE(is_finite(rotation_vector(Mat3::Constant(kNan))));
}

TEST(MathLinear, PosesComposeInvertAndApply) {
  const Pose a{rotation_rpy(0.1F, -0.4F, 2.0F), Vec3(0.1F, 0.2F, -0.3F)};
  const Pose b{rotation_rpy(-1.1F, 0.6F, 0.2F), Vec3(-0.5F, 0.0F, 0.7F)};
  const Vec3 point(0.3F, -0.2F, 0.9F);
  EXPECT_LT(difference(apply(a * b, point), apply(a, apply(b, point))), 3e-7F);
  const Pose round_trip = a * inverse(a);
  EXPECT_LT(difference(round_trip.rotation, Mat3::Identity()), 3e-7F);
  EXPECT_LT(difference(round_trip.position_m, Vec3::Zero()), 1e-7F);
}

TEST(MathLinear, SkewIsTheCrossProduct) {
  const Vec3 a(1.0F, -2.0F, 3.0F);
  const Vec3 b(0.5F, 4.0F, -1.0F);
  EXPECT_EQ(difference(skew(a) * b, cross(a, b)), 0.0F);
  EXPECT_EQ(cross(a, b).dot(a), 0.0F);
}

TEST(MathLinear, StorageConvertsBothWays) {
  const Xyz stored = to_xyz(Vec3(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(stored.x, 1.0F);
  EXPECT_EQ(stored.z, 3.0F);
  EXPECT_EQ(difference(to_vec(stored), Vec3(1.0F, 2.0F, 3.0F)), 0.0F);
}

TEST(MathLinear, NormalizeFallsBackWhereThereIsNoDirection) {
  const Vec3 none[] = {Vec3::Zero(), Vec3::Constant(kNan), Vec3::Constant(1e30F)};
  for (const Vec3& v : none) {
    EXPECT_EQ(difference(normalized_or(v, Vec3::UnitZ()), Vec3::UnitZ()), 0.0F);
  }
}

Mat6 damped_gram() {
  Mat6 a = Mat6::Zero();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      float sum = i == j ? 0.1F : 0.0F;
      for (int k = 0; k < 6; ++k) {
        sum += sin(static_cast<float>(7 * i + 3 * k)) * sin(static_cast<float>(7 * j + 3 * k));
      }
      a(i, j) = sum;
    }
  }
  return a;
}

TEST(MathLinear, SolveSpdSolves) {
  const Mat6 a = damped_gram();
  Vec6 expected;
  expected << 1.0F, -2.0F, 0.5F, 3.0F, -0.25F, 0.75F;
  Vec6 b = Vec6::Zero();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) b(i) += a(i, j) * expected(j);
  }
  Vec6 x;
  ASSERT_TRUE(solve_spd(a, b, x));
  EXPECT_LT(difference(x, expected), 2e-4F);
}

TEST(MathLinear, SolveSpdRefusesWhatIsNotPositiveDefinite) {
  Vec6 x;
  EXPECT_FALSE(solve_spd(Mat6::Zero(), Vec6::Ones(), x));
  EXPECT_EQ(difference(x, Vec6::Zero()), 0.0F);
  EXPECT_FALSE(solve_spd(Mat6::Ones(), Vec6::Ones(), x));
  EXPECT_FALSE(solve_spd(-Mat6::Identity(), Vec6::Ones(), x));
  EXPECT_FALSE(solve_spd(Mat6::Constant(kNan), Vec6::Ones(), x));
  EXPECT_FALSE(solve_spd(Mat6::Identity(), Vec6::Constant(kNan), x));
}

}  // namespace
}  // namespace verp::math
