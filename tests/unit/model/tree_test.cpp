#include "common/model/tree.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/test_robot.hpp"

namespace verp::model {
namespace {

using test::kRobot;

TEST(Tree, FindsEveryJointByItsName) {
  for (int j = 0; j < test::kJointCount; ++j) {
    EXPECT_EQ(find_joint(kRobot, test::kRows[j].name), j) << test::kRows[j].name;
  }
}

TEST(Tree, DoesNotFindPartsOfNames) {
  EXPECT_EQ(find_joint(kRobot, "l_kne"), -1);
  EXPECT_EQ(find_joint(kRobot, "l_knee_"), -1);
  EXPECT_EQ(find_joint(kRobot, ""), -1);
}

TEST(Tree, SubtreeOfTheBodyIsAllJoints) {
  EXPECT_EQ(subtree(kRobot, 0), (1u << test::kJointCount) - 1);
}

// Joint j moves node j + 1.
TEST(Tree, SubtreeIsTheJointAndAllBeyondIt) {
  const int knee = find_joint(kRobot, "l_knee");
  EXPECT_EQ(subtree(kRobot, knee + 1), 7u << knee);
  const int hip = find_joint(kRobot, "r_hip_yaw");
  EXPECT_EQ(subtree(kRobot, hip + 1), 0x3Fu << hip);
  const int last = find_joint(kRobot, "head_roll");
  EXPECT_EQ(subtree(kRobot, last + 1), 1u << last);
}

void expect_path(int from, int to, const int* nodes, int length) {
  const Path found = path(kRobot, from, to);
  ASSERT_EQ(found.length, length);
  for (int i = 0; i < length; ++i) EXPECT_EQ(int{found.node[i]}, nodes[i]) << "at " << i;
}

TEST(Tree, PathLeadsThroughTheNearestCommonAncestor) {
  const int arm_to_arm[] = {6, 5, 4, 0, 7, 8, 9};
  expect_path(6, 9, arm_to_arm, 7);
  const int down[] = {10, 11, 12, 13};
  expect_path(10, 13, down, 4);
  const int up[] = {13, 12, 11, 10};
  expect_path(13, 10, up, 4);
  const int here[] = {13};
  expect_path(13, 13, here, 1);
  const int body_to_head[] = {0, 1, 2, 3};
  expect_path(0, 3, body_to_head, 4);
}

TEST(Tree, EveryPathGoesFromLinkToNeighbouringLink) {
  for (int from = 0; from <= kRobot.joint_count; ++from) {
    for (int to = 0; to <= kRobot.joint_count; ++to) {
      const Path found = path(kRobot, from, to);
      ASSERT_GE(found.length, 1);
      EXPECT_EQ(int{found.node[0]}, from);
      EXPECT_EQ(int{found.node[found.length - 1]}, to);
      for (int i = 0; i + 1 < found.length; ++i) {
        const int a = found.node[i], b = found.node[i + 1];
        const bool up = a > 0 && kRobot.joint[a - 1].parent == b;
        const bool down = b > 0 && kRobot.joint[b - 1].parent == a;
        EXPECT_TRUE(up || down) << a << " to " << b;
      }
    }
  }
}

TEST(Tree, DeepestChainIsSearched) {
  static Params chain;
  chain.joint_count = kMaxJoints;
  for (int j = 0; j < kMaxJoints; ++j) chain.joint[j].parent = static_cast<std::uint8_t>(j);
  EXPECT_EQ(subtree(chain, 0), 0xFFFFFFFFu);
  EXPECT_EQ(subtree(chain, 32), 0x80000000u);
  EXPECT_EQ(path(chain, 0, kMaxJoints).length, kMaxNodes);
}

TEST(Tree, TotalMassIsTheSumOfAllLinks) {
  EXPECT_NEAR(total_mass(kRobot), 3.262F, 0.001F);
  EXPECT_EQ(total_mass(Params{}), 0.0F);
}

}  // namespace
}  // namespace verp::model
