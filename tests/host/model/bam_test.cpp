#include <gtest/gtest.h>

#include <string>

#include "host/robot/model/check.hpp"
#include "tests/host/model/bad_input.hpp"

namespace verp::model {
namespace {

// Names of Rhoban's files; the numbers are ours.
const std::string kMotor =
    "{\n\"kt\": 1.5, \"R\": 3.0,\n\"armature\": 0.011,\n\"friction_base\": 0.04, "
    "\"friction_viscous\": 0.02, \"model\": \"m\", \"actuator\": \"mine\"";
const std::string kStribeck =
    ", \"friction_stribeck\": 0.03, \"dtheta_stribeck\": 2.0, \"alpha\": 1.2";
const std::string kDirections =
    ", \"load_friction_motor\": 0.3, \"load_friction_external\": 0.1, "
    "\"load_friction_motor_stribeck\": 0.2, \"load_friction_external_stribeck\": 0.05";

std::string with(const TemporaryFile& bam, const std::string& more = "") {
  std::string text =
      edited("<verp:bus name=\"dxl\"", "<verp:servo_type name=\"mine\" like=\"xm430_w210\" bam=\"" +
                                           std::filesystem::path(bam.path()).filename().string() +
                                           "\" " + more + "/>\n    <verp:bus name=\"dxl\"");
  const std::string type = "type=\"xm430_w210\"";
  for (auto at = text.find(type); at != std::string::npos; at = text.find(type))
    text.replace(at, type.size(), "type=\"mine\"");
  return text;
}

Entity loaded(const std::string& json, const std::string& more = "") {
  const TemporaryFile bam("servo.json", json);
  const TemporaryFile file("robot.sdf", with(bam, more));
  return load_robot(file.path());
}

std::string refusal(const std::string& json) {
  try {
    loaded(json);
  } catch (const LoadError& error) {
    return std::to_string(error.line) + ": " + error.message;
  }
  return "";
}

TEST(Bam, AFileGivesMotorRotorAndGears) {
  const Servo servo = loaded(kMotor + kStribeck + kDirections +
                             ", \"load_friction_motor_quad\": 0.004, "
                             "\"load_friction_external_quad\": 0.006}")
                          .joints.front()
                          .servo;
  EXPECT_DOUBLE_EQ(servo.stall_torque_n_m, 1.5 * 12 / 3);
  EXPECT_DOUBLE_EQ(servo.no_load_speed_rad_s, 8);
  const Gearbox& g = servo.gearbox;
  EXPECT_TRUE(g.is_directional);
  const double read[] = {g.armature_kg_m2,   g.f_base_n_m,      g.f_strib_n_m,
                         g.f_visc_n_m_s,     g.w_s_rad_s,       g.alpha,
                         g.l_base,           g.l_strib,         g.l_external,
                         g.l_external_strib, g.q_motor_per_n_m, g.q_external_per_n_m};
  const double given[] = {0.011, 0.04, 0.03, 0.02, 2, 1.2, 0.3, 0.2, 0.1, 0.05, 0.004, 0.006};
  for (std::size_t i = 0; i < std::size(given); ++i) EXPECT_DOUBLE_EQ(read[i], given[i]) << i;
  EXPECT_EQ(servo.armature_band + servo.friction_band, 0);
  EXPECT_EQ(servo.source.find("BAM m of mine, "), 0U) << servo.source;
}

TEST(Bam, AModelWithoutATermHasNoneOfTheTypeItIsLike) {
  const Gearbox m1 = loaded(kMotor + "}").joints.front().servo.gearbox;
  EXPECT_EQ(m1.f_strib_n_m + m1.l_base + m1.l_strib, 0);
  EXPECT_FALSE(m1.is_directional);
  const Gearbox m4 =
      loaded(kMotor + kStribeck + ", \"load_friction_base\": 0.1, \"load_friction_stribeck\": 0.2}")
          .joints.front()
          .servo.gearbox;
  EXPECT_FALSE(m4.is_directional);
  EXPECT_DOUBLE_EQ(m4.l_base, 0.1);
  EXPECT_DOUBLE_EQ(m4.l_strib, 0.2);
}

TEST(Bam, AttributesComeBeforeTheFile) {
  const Servo servo =
      loaded(kMotor + "}", "stall_torque_n_m=\"4\" no_load_rev_min=\"60\" f_base_n_m=\"0.07\"")
          .joints.front()
          .servo;
  EXPECT_DOUBLE_EQ(servo.stall_torque_n_m, 4);
  EXPECT_DOUBLE_EQ(servo.gearbox.f_base_n_m, 0.07);
  EXPECT_DOUBLE_EQ(servo.gearbox.armature_kg_m2, 0.011);
}

TEST(Bam, WhatTheTwinHasNoUseForIsNamed) {
  const Entity robot = loaded(kMotor + ", \"q_offset\": 0.01, \"max_velocity\": 5.0}");
  const std::string text = describe(robot);
  const auto at = text.find("the twin has no use for max_velocity, q_offset of ");
  EXPECT_NE(at, std::string::npos) << text;
  EXPECT_EQ(text.find("the twin has no use for", at + 1), std::string::npos) << "once a type";
}

TEST(Bam, SlipsAreNamedAtTheirLine) {
  EXPECT_EQ(refusal("{\"kt\": 1.5,\n"), "2: is not well-formed JSON");
  EXPECT_EQ(refusal("[1]"), "1: holds no parameters");
  EXPECT_EQ(refusal("{\"armature\": 0.01}"), "1: it lacks \"friction_base\"");
  EXPECT_EQ(refusal("{\n\"armature\": \"much\"}"), "2: \"armature\" is no number");
  EXPECT_EQ(refusal(kMotor + kStribeck + ",\n\"load_friction_base\": 1.5}"),
            "5: \"load_friction_base\" is 1.5");
  expect_refused(edited("<verp:bus name=\"dxl\"",
                        "<verp:servo_type name=\"mine\" like=\"mx64\" bam=\"none.json\"/>"
                        "<verp:bus name=\"dxl\""),
                 "<verp:servo_type", "none.json");
}

}  // namespace
}  // namespace verp::model
