#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "host/twin/sim/robot.hpp"
#include "tests/host/sim/test_robots.hpp"

namespace verp::sim {
namespace {

constexpr double kSoleWidth = 0.066;

struct Outcome {
  double soles_between_m;  ///< least, of the soles' middles
  std::uint64_t contact_steps;
  std::array<int, 2> nodes;
  bool foot_force_valid;
};

Outcome press_feet_together(const model::Entity& entity) {
  World world({.ground = false});
  TwinOptions options;
  options.imperfections = Imperfections::none();
  options.cradle = Cradle::kAlways;
  TwinRobot robot(world, entity, options);
  for (int foot = 0; foot < 2; ++foot) {
    const int hip_roll = entity.limbs[static_cast<std::size_t>(foot)].joints[1];
    ServoSetpoint& servo = robot.setpoint(hip_roll);
    servo.torque_on = true;
    servo.p_gain = 3500;
    const double goal_rad = foot == 0 ? -0.1 : 0.1;
    servo.goal_count = 2048 + static_cast<int>(goal_rad * 4096 / (2 * std::numbers::pi));
  }
  Outcome out{1, 0, {}, false};
  for (int ms = 1; ms <= 1000; ++ms) {
    robot.advance_to(static_cast<std::uint64_t>(ms) * 1000);
    const Truth truth = robot.truth();
    out.soles_between_m = std::min(out.soles_between_m, truth.foot[0].centroid_world_m.y() -
                                                            truth.foot[1].centroid_world_m.y());
  }
  out.contact_steps = robot.self_contact_steps();
  out.nodes = robot.self_contact_nodes();
  out.foot_force_valid = robot.truth().foot[0].contact || robot.truth().foot[1].contact;
  return out;
}

int foot_node(const model::Entity& entity, std::size_t foot) {
  return entity.limbs[foot].joints.back() + 1;
}

TEST(SelfContact, FeetPressedTogetherStopEachOther) {
  const model::Entity entity = test::biped();
  const Outcome out = press_feet_together(entity);
  EXPECT_GT(out.soles_between_m, kSoleWidth - 0.004) << "the rubber gives a little";
  EXPECT_LT(out.soles_between_m, kSoleWidth + 0.003) << "each is tilted a little";
  EXPECT_GT(out.contact_steps, 500U);
  EXPECT_EQ(std::min(out.nodes[0], out.nodes[1]), foot_node(entity, 0));
  EXPECT_EQ(std::max(out.nodes[0], out.nodes[1]), foot_node(entity, 1));
  EXPECT_FALSE(out.foot_force_valid) << "no ground carries it";
}

TEST(SelfContact, DeclaredPairsPassThroughEachOther) {
  model::Entity entity = test::biped();
  entity.no_collide.push_back({foot_node(entity, 0), foot_node(entity, 1), "to show it"});
  const Outcome out = press_feet_together(entity);
  EXPECT_LT(out.soles_between_m, kSoleWidth - 0.01);
  EXPECT_EQ(out.contact_steps, 0U);
}

TEST(SelfContact, NeighboursOverlapAtTheirJoint) {
  World world;
  model::Entity entity = test::arm();
  test::add_collision(entity.nodes[0], {0.2, 0.2, 0.2});
  test::add_collision(entity.nodes[1], {0.05, 0.05, 0.2});
  TwinOptions options;
  options.cradle = Cradle::kAlways;
  TwinRobot robot(world, entity, options);
  robot.advance_to(500'000);
  EXPECT_EQ(robot.self_contact_steps(), 0U);
}

TEST(SelfContact, TwoRobotsWithEqualLinksStillMeet) {
  const GeomTag mine{.owner = 0, .node = 1, .surface = {}, .passes = 1U << 2};
  const GeomTag own{.owner = 0, .node = 2, .surface = {}, .passes = 1U << 1};
  const GeomTag theirs{.owner = 1, .node = 2, .surface = {}, .passes = 1U << 1};
  const GeomTag ground;
  EXPECT_FALSE(mine.collides_with(own));
  EXPECT_TRUE(mine.collides_with(theirs));
  EXPECT_TRUE(mine.collides_with(ground));
  EXPECT_TRUE(ground.collides_with(mine));
  EXPECT_FALSE(ground.collides_with(ground));
}

}  // namespace
}  // namespace verp::sim
