#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "host/robot/model/check.hpp"
#include "host/robot/model/params.hpp"
#include "host/robot/model/supply.hpp"
#include "tests/host/model/bad_input.hpp"

/// Motors, supply and friction that no table knows.
namespace verp::model {
namespace {

const std::string kBus = "<verp:bus name=\"dxl\"";
const std::string kGain = " p_gain=\"3112\"";
const std::string kOldType = "type=\"xm430_w210\"";

std::string with(const std::string& elements) {
  return edited(kBus, elements + "\n    " + kBus);
}

Entity loaded(const std::string& text) {
  const TemporaryFile file("robot.sdf", text);
  return load_robot(file.path());
}

/// generic21 with servos of that type. An empty `gain` leaves the choice of gains to the loader.
Entity driven_by(const std::string& attributes, const std::string& elements = "",
                 const std::string& gain = kGain) {
  std::string text = with("<verp:servo_type name=\"mine\" " + attributes + "/>" + elements);
  for (auto from = text.find(kOldType); from != std::string::npos; from = text.find(kOldType))
    text.replace(from, kOldType.size(), "type=\"mine\"");
  for (auto from = text.find(kGain); gain != kGain && from != std::string::npos;
       from = text.find(kGain))
    text.replace(from, kGain.size(), gain);
  return loaded(text);
}

TEST(Motors, WhatATypeDoesNotSayIsEstimatedAndNamed) {
  const Entity robot = driven_by(
      "protocol=\"dynamixel2\" model_number=\"4711\" stall_torque_n_m=\"24\" "
      "no_load_rev_min=\"77\"");
  const Servo& servo = robot.joints[0].servo;
  const double gear = 212.6 / 2;  // eight times the torque: half the rotor's speed
  EXPECT_NEAR(servo.gearbox.armature_kg_m2, 1e-5 * gear * 24, 1e-9);
  EXPECT_NEAR(servo.gearbox.f_base_n_m, 0.005 * 24, 1e-9);
  EXPECT_NEAR(servo.heat_capacity_j_k, 8 * 74, 1e-9);
  EXPECT_NEAR(servo.heat_resistance_k_w, 13.0 / 4, 1e-9);
  EXPECT_EQ(servo.armature_band, 0.5);
  const std::string check = describe(robot);
  EXPECT_NE(check.find("estimated, not in the file: gear ratio 106, rotor, friction, heat "
                       "capacity, heat resistance"),
            std::string::npos)
      << check;
  EXPECT_NE(check.find("heat: 592 J/K, 3.25 K/W"), std::string::npos) << check;
}

TEST(Motors, ATypeLikeAnotherScalesWhatItsOwnMotorChanges) {
  const Servo like = loaded(with("")).joints[0].servo;
  const Servo servo =
      driven_by(
          "like=\"xm430_w210\" stall_torque_n_m=\"6\" no_load_rev_min=\"77\" gear_ratio=\"212.6\" "
          "heat_capacity_j_k=\"200\"")
          .joints[0]
          .servo;
  EXPECT_DOUBLE_EQ(servo.gearbox.armature_kg_m2, 2 * like.gearbox.armature_kg_m2);
  EXPECT_DOUBLE_EQ(servo.gearbox.f_visc_n_m_s, 2 * like.gearbox.f_visc_n_m_s);
  EXPECT_EQ(servo.heat_capacity_j_k, 200);
  EXPECT_EQ(servo.estimated, "rotor, friction, heat resistance");
  const Servo same = driven_by("like=\"xm430_w210\" title=\"the same\"").joints[0].servo;
  EXPECT_EQ(same.gearbox.armature_kg_m2, like.gearbox.armature_kg_m2);
  EXPECT_EQ(same.source, like.source);
  EXPECT_EQ(same.estimated, "");
}

std::optional<double> look_ahead_s(const Entity& robot) {
  for (const auto& [name, value] : robot.tuning) {
    if (name == "gait.look_ahead_s") return value;
  }
  return std::nullopt;
}

/// Gears without friction: only the motor damps.
TEST(Motors, GainsLeaveARobotDampedAndTheGaitLooksAheadByTheirLag) {
  const Entity robot = driven_by(
      "like=\"xm430_w210\" stall_torque_n_m=\"3\" no_load_rev_min=\"119\" source=\"a test\" "
      "f_base_n_m=\"0\" f_strib_n_m=\"0\" l_base=\"0\" l_strib=\"0\" f_visc_n_m_s=\"0\"",
      "", "");
  const Servo& servo = robot.joints.back().servo;
  const double damping = servo.stall_torque_n_m / servo.no_load_speed_rad_s;
  const double stiffness = servo_stiffness_n_m_rad(servo), leg_m = 0.186;
  const double inertia = total_mass(robot) * leg_m * leg_m;
  EXPECT_NEAR(damping / (2 * std::sqrt(stiffness * inertia)), 0.095, 0.001);
  EXPECT_GT(stiffness, total_mass(robot) * kGravity_m_s2 * leg_m) << "it stands";
  EXPECT_NEAR(look_ahead_s(robot).value_or(0), damping / stiffness + 0.005, 1e-4);
}

TEST(Motors, FrictionOfHobbyGearsDampsEnoughForTheUsualGains) {
  const Entity robot = driven_by("like=\"xm430_w210\"", "", "");
  EXPECT_NEAR(servo_stiffness_n_m_rad(robot.joints.back().servo), 53.7, 0.1);
  EXPECT_EQ(look_ahead_s(robot), std::nullopt);
}

TEST(Motors, NumbersThatNoMotorHasAreRefused) {
  const std::string at = "<verp:servo_type";
  for (const char* const bad : {"0", "-1", "nan"}) {
    for (const char* const name :
         {"heat_capacity_j_k", "heat_resistance_k_w", "gear_ratio", "peak_torque_n_m"}) {
      expect_refused(with("<verp:servo_type name=\"mine\" like=\"mx64\" " + std::string(name) +
                          "=\"" + bad + "\"/>"),
                     at, name);
    }
  }
}

TEST(Supply, IsTheFilesOrAnEstimateThatSagsNoMoreThanGeneric21s) {
  const Entity generic21 = loaded(with(""));
  EXPECT_EQ(supply_resistance_ohm(generic21), 0.1);
  EXPECT_EQ(supply_volts(generic21), 12);
  EXPECT_NE(describe(generic21).find("0.1 ohm, an estimate"), std::string::npos);
  const Entity strong = driven_by(
      "like=\"xm430_w210\" nominal_v=\"24\" stall_torque_n_m=\"30\" no_load_rev_min=\"77\" "
      "stall_current_a=\"11.5\"");
  EXPECT_NEAR(supply_resistance_ohm(strong), 0.1 * 4 / 10, 1e-4) << "ten times the power";
  const Entity own = loaded(with("<verp:supply volts=\"14.8\" resistance_ohm=\"0.03\"/>"));
  EXPECT_EQ(supply_volts(own), 14.8);
  EXPECT_EQ(supply_resistance_ohm(own), 0.03);
  EXPECT_EQ(describe(own).find("an estimate for servos"), std::string::npos);
}

TEST(Supply, NumbersThatNoBatteryHasAreRefused) {
  const std::string at = "<verp:supply";
  expect_refused(with("<verp:supply resistance_ohm=\"-0.1\"/>"), at, "resistance_ohm");
  expect_refused(with("<verp:supply resistance_ohm=\"nan\"/>"), at, "resistance_ohm");
  expect_refused(with("<verp:supply volts=\"0\"/>"), at, "volts");
  expect_refused(with("<verp:supply volts=\"48\"/>"), at, "4 times what the servos are made for");
  expect_refused(with("<verp:supply amperes=\"3\"/>"), at, "amperes");
}

std::string with_dynamics(const std::string& elements) {
  std::string text = with(elements);
  const auto limit = text.find("<limit>");
  return text.insert(limit, "<dynamics><friction>0.3</friction><damping>0.2</damping></dynamics>");
}

TEST(JointFriction, OfFileAndServoAddUpUntilTheFileChooses) {
  const auto joint = [](const Entity& robot) {
    for (const Joint& each : robot.joints) {
      if (each.friction_n_m > 0 || each.servo.gearbox.l_strib == 0) return each;
    }
    return robot.joints[0];
  };
  const Entity sum = loaded(with_dynamics(""));
  EXPECT_EQ(joint(sum).friction_n_m, 0.3);
  EXPECT_GT(joint(sum).servo.gearbox.l_strib, 0);
  EXPECT_NE(describe(sum).find("1 joints in the file (up to 0.3 N m and 0.2 N m s/rad) is added"),
            std::string::npos);
  const Entity servo = loaded(with_dynamics("<verp:friction from=\"servo\"/>"));
  for (const Joint& each : servo.joints) EXPECT_EQ(each.friction_n_m + each.damping_n_m_s, 0);
  const Joint file = joint(loaded(with_dynamics("<verp:friction from=\"file\"/>")));
  EXPECT_EQ(file.damping_n_m_s, 0.2);
  EXPECT_EQ(file.servo.gearbox.l_strib + file.servo.gearbox.f_base_n_m, 0);
  EXPECT_GT(file.servo.gearbox.armature_kg_m2, 0);
  expect_refused(with("<verp:friction from=\"gears\"/>"), "<verp:friction", "from='gears'");
}

}  // namespace
}  // namespace verp::model
