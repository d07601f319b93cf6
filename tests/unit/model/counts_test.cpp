#include "common/model/counts.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/support/test_robot.hpp"

namespace verp::model {
namespace {

using test::kRobot;

TEST(Counts, AngleAndCountAreInverse) {
  for (int j = 0; j < kRobot.joint_count; ++j) {
    const JointParams& joint = kRobot.joint[j];
    EXPECT_EQ(count_of(joint, 0), 2048);
    for (std::int32_t count = 0; count < 4096; count += 111) {
      EXPECT_EQ(count_of(joint, angle_of(joint, count)), count);
    }
  }
}

TEST(Counts, DirectionIsInTheScale) {
  EXPECT_GT(count_of(kRobot.joint[test::kLeftLeg + 3], 1), 2048);
  EXPECT_LT(count_of(kRobot.joint[test::kRightLeg + 3], 1), 2048) << "mounted backwards";
}

TEST(Counts, AreTotal) {
  EXPECT_EQ(angle_of(JointParams{}, 123), 0.0F);
  EXPECT_EQ(count_of(kRobot.joint[0], test::quiet_nan()), 0);
  EXPECT_EQ(count_of(kRobot.joint[0], 1e30F), std::numeric_limits<std::int32_t>::max());
}

}  // namespace
}  // namespace verp::model
