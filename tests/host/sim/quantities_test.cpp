#include "host/twin/sim/quantities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/host/sim/test_robots.hpp"

// Hand-calculated. g, h: gravity and the physics step.

namespace verp::sim::test {
namespace {

constexpr double g = 9.80665, h = 0.001;

/// 2 kg, 0.2 m.
model::Entity lone(bool ball) {
  model::Entity entity;
  entity.nodes.push_back(box("it", 2, {0.2, 0.2, 0.2}, {0, 0, 0}));
  add_collision(entity.nodes[0], {0.2, 0.2, 0.2});
  if (ball) {
    entity.nodes[0].collisions[0].shape = model::Collision::Shape::kSphere;
    entity.nodes[0].collisions[0].size_m = {0.1, 0, 0};
  }
  return entity;
}

struct Scene {
  explicit Scene(const model::Entity& what, Cradle cradle = Cradle::kNone)
      : entity(what),
        robot(world, entity, {.imperfections = Imperfections::none(), .cradle = cradle}),
        q(world) {
    q.add(robot);
  }
  double read(const std::string& name) const { return q.read(name); }
  void set(const std::string& name, double value) { q.set(name, value); }
  void run(double s) {
    world.advance_to(world.now_us() + static_cast<std::uint64_t>(std::llround(1e6 * s)));
  }
  World world;
  model::Entity entity;
  TwinRobot robot;
  Quantities q;
};

TEST(Quantities, OfAFallingBody) {
  Scene s(lone(false));
  s.set("it.position_m.z", 3);
  s.set("it.velocity_m_s.x", 0.5);
  s.run(0.5);
  const double v = g * 0.5;
  EXPECT_NEAR(s.read("it.position_m.z"), 3 - v * (0.5 + h) / 2, 1e-9);
  EXPECT_NEAR(s.read("it.position_m.x"), 0.25, 1e-9);
  EXPECT_NEAR(s.read("it.velocity_m_s.z"), -v, 1e-9);
  EXPECT_NEAR(s.read("it.acceleration_m_s2.z"), -g, 1e-6);
  EXPECT_NEAR(s.read("it.momentum_kg_m_s.z"), -2 * v, 1e-9);
  EXPECT_NEAR(s.read("it.kinetic_energy_j"), v * v + 0.25, 1e-9);
  EXPECT_NEAR(s.read("it.potential_energy_j"), 2 * g * s.read("it.position_m.z"), 1e-9);
  EXPECT_NEAR(s.read("robot.kinetic_energy_j"), s.read("it.kinetic_energy_j"), 1e-12);
  EXPECT_NEAR(s.read("robot.momentum_kg_m_s.x"), 1, 1e-9);
  EXPECT_NEAR(s.read("world.time_s"), 0.5, 1e-12);
  s.set("world.gravity_m_s2", 1.62);
  s.run(h);
  EXPECT_NEAR(s.read("it.acceleration_m_s2.z"), -1.62, 1e-6);
  EXPECT_NEAR(s.read("world.gravity_m_s2"), 1.62, 0);
}

TEST(Quantities, ForcesTorquesAndImpulsesMoveWhatTheyActOn) {
  Scene s(lone(false));
  s.set("world.gravity_m_s2", 0);
  s.set("it.position_m.z", 2);
  s.set("it.force_n.x", 4);
  s.run(0.5);
  EXPECT_NEAR(s.read("it.acceleration_m_s2.x"), 2, 1e-9);
  EXPECT_NEAR(s.read("it.velocity_m_s.x"), 1, 1e-9);
  EXPECT_NEAR(s.read("it.impulse_n_s.x"), 2, 1e-9);
  EXPECT_NEAR(s.read("it.force_n.x"), 4, 0);
  s.set("it.mass_kg", 4);
  s.run(h);
  EXPECT_NEAR(s.read("it.acceleration_m_s2.x"), 1, 1e-9);
  EXPECT_NEAR(s.read("robot.mass_kg"), 4, 1e-12);
  s.set("it.force_n.x", 0);
  s.set("it.impulse_n_s.y", 6);
  s.run(2 * h);
  EXPECT_NEAR(s.read("it.velocity_m_s.y"), 1.5, 1e-9);

  s.set("it.inertia_kg_m2.zz", 0.02);
  s.set("it.torque_n_m.z", 0.1);
  s.run(0.1);
  EXPECT_NEAR(s.read("it.angular_acceleration_rad_s2.z"), 5, 1e-9);
  EXPECT_NEAR(s.read("it.angular_velocity_rad_s.z"), 0.5, 1e-9);
  EXPECT_NEAR(s.read("it.angular_momentum_kg_m2_s.z"), 0.01, 1e-9);
  EXPECT_NEAR(s.read("it.yaw_rad"), 5 * 0.1 * (0.1 + h) / 2, 1e-6);

  s.q.push("it", {0, 0, 8}, 0.25);
  s.run(1);
  EXPECT_NEAR(s.read("it.velocity_m_s.z"), 8 * 0.25 / 4, 1e-9);
}

TEST(Quantities, APoseIsSetAsAPersonWouldPutIt) {
  Scene s(lone(false));
  s.set("world.gravity_m_s2", 0);
  s.set("it.position_m.y", -0.5);
  s.set("it.position_m.z", 1.5);
  for (const char* angle : {"it.roll_rad", "it.pitch_rad", "it.yaw_rad"}) s.set(angle, 0.3);
  s.set("it.angular_velocity_rad_s.y", 2);
  EXPECT_NEAR(s.read("it.position_m.y"), -0.5, 1e-12);
  EXPECT_NEAR(s.read("it.position_m.z"), 1.5, 1e-12);
  for (const char* angle : {"it.roll_rad", "it.pitch_rad", "it.yaw_rad"})
    EXPECT_NEAR(s.read(angle), 0.3, 1e-12) << angle;
  EXPECT_NEAR(s.read("it.angular_velocity_rad_s.y"), 2, 1e-12);
}

TEST(Quantities, OfABoxThatSlides) {
  Scene s(lone(false));
  s.run(0.2);
  s.set("it.velocity_m_s.x", 2);
  s.set("it.friction", 0.3);
  s.run(0.4);
  EXPECT_NEAR(s.read("it.velocity_m_s.x"), 2 - 0.3 * g * 0.4, 0.02);
  EXPECT_NEAR(s.read("it.contact_force_n.z"), 2 * g, 0.2);
  EXPECT_NEAR(s.read("it.contact_force_n.x"), -0.3 * 2 * g, 0.1);
  s.set("ground.friction", 0);
  s.run(h);
  const double v = s.read("it.velocity_m_s.x");
  s.run(0.2);
  EXPECT_NEAR(s.read("it.velocity_m_s.x"), v, 1e-6) << "the smaller of the two counts";
}

TEST(Quantities, OfABallThatBouncesAndSinksIn) {
  Scene s(lone(true));
  s.set("it.contact_stiffness_n_m", 0);
  s.set("it.restitution", 0.5);
  s.set("it.position_m.z", 0.6);
  double down = 0;
  while (s.read("it.velocity_m_s.z") <= 0 && s.read("world.time_s") < 1) {
    down = s.read("it.velocity_m_s.z");
    s.run(h);
  }
  EXPECT_NEAR(s.read("it.velocity_m_s.z"), -0.5 * (down - g * h), 0.02);
  s.set("it.restitution", 0);
  s.set("it.contact_stiffness_n_m", 1e4);
  s.set("it.contact_damping_n_s_m", 200);
  s.run(2);
  EXPECT_NEAR(s.read("it.position_m.z"), 0.1 - 2 * g / 1e4, 2e-5);

  // Implicit Euler: v' = v / (1 + h (h k + d) / m).
  s.set("world.gravity_m_s2", 0);
  s.set("it.position_m.z", 0.1 - 1e-9);
  s.set("it.velocity_m_s.z", -0.1);
  s.set("it.contact_damping_n_s_m", 300);
  s.run(h);
  EXPECT_NEAR(s.read("it.velocity_m_s.z"), -0.1 / (1 + h * (h * 1e4 + 300) / 2), 1e-5);
}

TEST(Quantities, DampedSpeedsFadeByTheirTimeConstant) {
  Scene s(lone(true));
  s.set("world.gravity_m_s2", 0);
  s.set("it.position_m.z", 5);
  s.set("it.velocity_m_s.x", 1);
  s.set("it.angular_velocity_rad_s.z", 3);
  s.set("it.linear_damping_1_s", 2);
  s.set("it.angular_damping_1_s", 1);
  s.run(0.5);
  EXPECT_NEAR(s.read("it.velocity_m_s.x"), std::exp(-1), 1e-6);
  EXPECT_NEAR(s.read("it.angular_velocity_rad_s.z"), 3 * std::exp(-0.5), 1e-6);
  s.set("it.linear_damping_1_s", 0);
  s.run(0.5);
  EXPECT_NEAR(s.read("it.velocity_m_s.x"), std::exp(-1), 1e-6);
}

TEST(Quantities, OfAPendulum) {
  Scene s(arm(), Cradle::kAlways);
  s.set("base.position_m.z", 1);
  const double turned = kArmInertia + kArmMass * kArmLength * kArmLength;
  // An impulse at the centre of mass, without gravity.
  s.set("world.gravity_m_s2", 0);
  s.set("arm.impulse_n_s.x", 0.05);
  s.run(h);
  const double w0 = -0.05 * kArmLength / turned;
  EXPECT_NEAR(s.read("shoulder.speed_rad_s"), w0, 0.01 * std::abs(w0));
  s.set("shoulder.damping_n_m_s", 0.01);
  s.run(0.2);
  EXPECT_NEAR(s.read("shoulder.speed_rad_s"), w0 * std::exp(-0.01 * 0.2 / turned),
              0.01 * std::abs(w0));
  s.set("shoulder.damping_n_m_s", 0);
  s.set("shoulder.friction_n_m", 0.005);
  const double before = s.read("shoulder.speed_rad_s");
  s.run(0.1);
  EXPECT_NEAR(s.read("shoulder.speed_rad_s"), before + 0.005 * 0.1 / turned,
              0.02 * std::abs(before));
  EXPECT_NEAR(s.read("shoulder.torque_n_m"), 0.005, 1e-4);
}

TEST(Quantities, APendulumSwingsByItsInertia) {
  Scene s(arm(), Cradle::kAlways);
  s.set("base.position_m.z", 1);
  s.set("arm.inertia_kg_m2.xx", 2e-3);
  s.set("arm.inertia_kg_m2.yy", 2e-3);
  s.set("arm.impulse_n_s.x", 0.005);
  const double turned = 2e-3 + kArmMass * kArmLength * kArmLength;
  const double period_s = 2 * std::numbers::pi * std::sqrt(turned / (kArmMass * g * kArmLength));
  double last = 0, first_s = 0, latest_s = 0;
  int crossings = 0;
  while (s.read("world.time_s") < 3) {
    s.run(h);
    const double now = s.read("shoulder.angle_rad");
    if (last < 0 && now >= 0) {
      latest_s = s.read("world.time_s");
      if (crossings++ == 0) first_s = latest_s;
    }
    last = now;
  }
  ASSERT_GT(crossings, 2);
  EXPECT_NEAR((latest_s - first_s) / (crossings - 1), period_s, 0.01 * period_s);
}

TEST(Quantities, WhatIsNotThereOrOutOfRangeIsRefusedInWords) {
  Scene s(lone(false));
  const auto why = [&](const char* name, double value) {
    try {
      s.set(name, value);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(why("it.mas_kg", 1), "there is no quantity 'it.mas_kg'");
  EXPECT_EQ(why("it.mass_kg", -1), "'it.mass_kg' is 0.001 to 1000 kg, not -1");
  EXPECT_EQ(why("it.mass_kg", std::nan("")), "'it.mass_kg' is 0.001 to 1000 kg, not nan");
  EXPECT_EQ(why("it.kinetic_energy_j", 1), "'it.kinetic_energy_j' can only be read");
  EXPECT_THROW(s.q.push("that", {1, 0, 0}, 1), std::invalid_argument);
}

TEST(Quantities, ReadingThemChangesNoBit) {
  World plain;
  const model::Entity entity = biped();
  TwinRobot alone(plain, entity, {.imperfections = Imperfections::none()});
  plain.advance_to(300'000);
  Scene watched(entity, Cradle::kUntilArmed);
  for (int i = 0; i < 300; ++i) {
    watched.run(h);
    for (const Quantity& each : watched.q.all()) each.read();
  }
  EXPECT_EQ(alone.truth().joint_rad, watched.robot.truth().joint_rad);
  EXPECT_EQ(alone.truth().com_world_m, watched.robot.truth().com_world_m);
}

}  // namespace
}  // namespace verp::sim::test
