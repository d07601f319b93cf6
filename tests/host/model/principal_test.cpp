#include "host/robot/model/principal.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace verp::model {
namespace {

// Equals Eigen's bit for bit without its seconds of compile time.
TEST(Principal, TheShortestTurnOfZIsEigens) {
  std::mt19937 random(1);
  std::normal_distribution<double> number;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 axis(i % 5 == 0 ? 0 : number(random), i % 7 == 0 ? 0 : number(random),
                    i % 35 == 0 ? 1 + i : number(random));
    const Eigen::Quaterniond eigens = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis);
    EXPECT_EQ(turn_of_z(axis).coeffs(), eigens.coeffs()) << axis.transpose();
  }
}

TEST(Principal, HalfATurnOfZIsAboutAnAxisAcross) {
  for (const Vec3& axis : {Vec3(0, 0, -1), Vec3(0, 0, -2.5), Vec3(1e-8, 0, -1), Vec3(0, 1e-8, -1),
                           Vec3(-1e-7, 1e-7, -1)}) {
    const Eigen::Quaterniond turn = turn_of_z(axis);
    EXPECT_NEAR(turn.norm(), 1, 1e-12) << axis.transpose();
    EXPECT_LT((turn * Vec3::UnitZ() - axis.normalized()).norm(), 1e-7) << axis.transpose();
    EXPECT_EQ(turn.z(), 0) << axis.transpose();
  }
}

}  // namespace
}  // namespace verp::model
