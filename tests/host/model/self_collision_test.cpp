#include "host/robot/model/self_collision.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/robot/model/check.hpp"
#include "host/robot/model/load.hpp"
#include "tests/host/model/test_files.hpp"

namespace verp::model {
namespace {

int node(const Entity& entity, const std::string& name) {
  for (std::size_t n = 0; n < entity.nodes.size(); ++n) {
    if (entity.nodes[n].name == name) return static_cast<int>(n);
  }
  ADD_FAILURE() << "no link " << name;
  return 0;
}

bool is_free(const Entity& entity, const std::string& a, const std::string& b) {
  const int link = std::min(node(entity, a), node(entity, b));
  const int other = std::max(node(entity, a), node(entity, b));
  return std::any_of(
      entity.no_collide.begin(), entity.no_collide.end(),
      [&](const NoCollide& pair) { return pair.link == link && pair.other == other; });
}

std::string with(const std::string& addition) {
  std::string text = read_text(robot_file("generic21"));
  text.insert(text.find("<verp:body"), addition);
  return text;
}

// Boxes around three meeting axes overlap.
TEST(SelfCollision, OfGeneric21OnlyTheLinksAroundAHipPassThroughEachOther) {
  const Entity e = load_robot(robot_file("generic21"));
  for (const NoCollide& pair : e.no_collide) {
    EXPECT_LE(joints_between(e, pair.link, pair.other), kNearJoints);
    EXPECT_NE(
        describe(e).find("'" + e.nodes[static_cast<std::size_t>(pair.link)].name + "' and '" +
                         e.nodes[static_cast<std::size_t>(pair.other)].name + "' don't collide"),
        std::string::npos);
  }
  EXPECT_TRUE(is_free(e, "trunk", "l_hip_cross"));
  EXPECT_TRUE(is_free(e, "l_hip_yaw_link", "l_thigh"));
  EXPECT_FALSE(is_free(e, "l_foot", "r_foot"));
  EXPECT_FALSE(is_free(e, "trunk", "l_forearm"));
  EXPECT_FALSE(is_free(e, "l_shank", "r_shank"));
}

TEST(SelfCollision, JointsAreCountedAlongOneChainOnly) {
  const Entity e = load_robot(robot_file("generic21"));
  EXPECT_EQ(joints_between(e, node(e, "trunk"), node(e, "l_thigh")), 3);
  EXPECT_EQ(joints_between(e, node(e, "l_thigh"), node(e, "trunk")), 3);
  EXPECT_EQ(joints_between(e, node(e, "l_foot"), node(e, "r_foot")), kMaxJoints);
  EXPECT_EQ(joints_between(e, node(e, "l_foot"), node(e, "l_foot")), 0);
}

// Overlapping feet push the robot apart.
TEST(SelfCollision, StandingInOneselfIsRefusedUnlessItIsDeclared) {
  const std::string box =
      "<verp:box frame=\"l_sole\" centre=\"0 -0.02 0.005\" size=\"0.1 0.08 0.01\"/>\n";
  const TemporaryFile file("robot.sdf", with(box));
  try {
    load_robot(file.path());
    FAIL() << "was accepted";
  } catch (const LoadError& error) {
    EXPECT_NE(error.message.find("'l_foot' and 'r_foot' overlap by"), std::string::npos)
        << error.what();
    EXPECT_NE(error.message.find("standing pose"), std::string::npos) << error.what();
    EXPECT_NE(error.fix.find("<verp:no_collide link=\"l_foot\" other=\"r_foot\""),
              std::string::npos)
        << error.what();
  }
  const TemporaryFile declared(
      "declared.sdf",
      with(box + "<verp:no_collide link=\"r_foot\" other=\"l_foot\" reason=\"a test\"/>\n"));
  const Entity e = load_robot(declared.path());
  EXPECT_TRUE(is_free(e, "l_foot", "r_foot"));
  EXPECT_NE(describe(e).find("don't collide: a test"), std::string::npos);
}

TEST(SelfCollision, DeclarationsThatSayNothingAreRefused) {
  for (const char* other : {"l_shank", "l_thigh", "nowhere"}) {
    const TemporaryFile file("robot.sdf", with("<verp:no_collide link=\"l_thigh\" other=\"" +
                                               std::string(other) + "\" reason=\"a test\"/>\n"));
    EXPECT_THROW(load_robot(file.path()), LoadError) << other;
  }
}

TEST(SelfCollision, ThirdPartyRobotsLoad) {
  for (const char* name : {"op3", "darwin_op"}) {
    const Entity e = load_robot(robot_file(name));
    for (const NoCollide& pair : e.no_collide)
      EXPECT_LE(joints_between(e, pair.link, pair.other), kNearJoints) << name;
  }
}

}  // namespace
}  // namespace verp::model
