#include <gtest/gtest.h>

#include <optional>

#include "tests/host/model/bad_input.hpp"

namespace verp::model {
namespace {

std::optional<double> tuned(const Entity& entity, const std::string& name) {
  for (const auto& [of, value] : entity.tuning) {
    if (of == name) return value;
  }
  return std::nullopt;
}

TEST(BadInput, ServoTypesOfTheFileAreReadAndTheirSlipsNamed) {
  const auto with = [](const std::string& type) {
    return edited("<verp:bus name=\"dxl\"", type + "\n    <verp:bus name=\"dxl\"");
  };
  const auto mine = [&](const std::string& attributes) {
    return with("<verp:servo_type name=\"mine\" " + attributes + "/>");
  };
  const std::string motor =
      "protocol=\"dynamixel2\" model_number=\"4711\" kt_n_m_a=\"1.5\" resistance_ohm=\"4\" ";
  const std::string gears =
      "armature_kg_m2=\"0.01\" f_base_n_m=\"0.05\" f_strib_n_m=\"0.02\" l_base=\"0.01\" "
      "l_strib=\"0.2\" "
      "w_s_rad_s=\"1.5\" alpha=\"1.3\" f_visc_n_m_s=\"0.01\" ";
  const std::string source = "source=\"my bench\"";
  const std::string at = "<verp:servo_type";

  std::string good = mine(motor + gears + source);
  const std::string old_type = "type=\"xm430_w210\"";
  for (auto from = good.find(old_type); from != std::string::npos; from = good.find(old_type)) {
    good.replace(from, old_type.size(), "type=\"mine\"");
  }
  std::string mixed = mine(
      "like=\"xm430_w210\" nominal_v=\"24\" stall_torque_n_m=\"3\" "
      "no_load_rev_min=\"77\" stall_current_a=\"2\"");
  mixed.replace(mixed.rfind(old_type), old_type.size(), "type=\"mine\"");
  expect_refused(mixed, "type=\"mine\"", "voltage");
  const TemporaryFile file("robot.sdf", good);
  const Servo servo = load_robot(file.path()).joints.front().servo;
  EXPECT_DOUBLE_EQ(servo.stall_torque_n_m, 1.5 * 12 / 4);
  EXPECT_DOUBLE_EQ(servo.no_load_speed_rad_s, 12 / 1.5);
  EXPECT_DOUBLE_EQ(servo.gearbox.armature_kg_m2, 0.01);
  EXPECT_DOUBLE_EQ(servo.gearbox.l_strib, 0.2);
  EXPECT_EQ(servo.source, "my bench");
  EXPECT_FALSE(tuned(load_robot(file.path()), "safety.voltage_low_v")) << "9.6 V, of 12";
  std::string strong = good;
  strong.replace(strong.find("kt_n_m_a"), 0, "nominal_v=\"24\" ");
  const TemporaryFile strong_file("robot.sdf", strong);
  EXPECT_NEAR(tuned(load_robot(strong_file.path()), "safety.voltage_low_v").value_or(0), 19.2,
              1e-6);
  EXPECT_EQ(servo.armature_band, 0);

  expect_refused(mine(motor + gears), at, "source");
  expect_refused(mine("like=\"mx64\" f_visc_n_m_s=\"0.01\""), at, "source");
  expect_refused(mine(gears + source), at, "protocol");
  expect_refused(mine(motor + gears + "stall_torque_n_m=\"3\" " + source), at, "motor twice");
  expect_refused(mine("like=\"xm430\" armature_kg_m2=\"0.01\" " + source), at,
                 "no servo type 'xm430'");
  expect_refused(mine("like=\"mx64\" armature_kg_m2=\"-0.01\" " + source), at, "armature_kg_m2");
  expect_refused(mine("like=\"mx64\" l_strib=\"1.2\""), at, "l_strib");
  expect_refused(mine("like=\"mx64\" l_base=\"0.98\" " + source), at, "lock the gears");
  expect_refused(mine("like=\"mx64\" armature_kg_m2=\"1e4\" " + source), at, "armature_kg_m2");
  expect_refused(mine("like=\"mx64\" alpha=\"0\""), at, "alpha");
  expect_refused(mine("like=\"mx64\" friction_band=\"1\""), at, "friction_band");
  expect_refused(mine("like=\"mx64\" nominal_v=\"24\""), at, "nominal_v");
  expect_refused(mine("like=\"mx64\" loop_us=\"0\""), at, "loop_us");
  expect_refused(mine("like=\"mx64\" gear=\"200\""), at, "gear");
  expect_refused(with("<verp:servo_type name=\"mx64\" like=\"mx106\"/>"), at, "already");
  expect_refused(with("<verp:servo_type name=\"mine\" like=\"mx64\"><gear/></verp:servo_type>"),
                 "<gear/>", "unknown element <gear>");
}

TEST(BadInput, WhatTheServosModelLacksIsRefused) {
  const auto with = [](const std::string& type, const std::string& baud) {
    std::string text = edited("<verp:bus name=\"dxl\"", type + "\n    <verp:bus name=\"dxl\"");
    return text.replace(text.find("baud=\"2000000\""), 14, "baud=\"" + baud + '"');
  };
  const auto mine = [&](const std::string& attributes) {
    return with("<verp:servo_type name=\"mine\" like=\"mx28\" " + attributes + "/>", "2000000");
  };
  expect_refused(mine("fast_sync_read=\"1\""), "<verp:servo_type", "MX-28(2.0), which has no Fast");
  expect_refused(mine("counts_per_rev=\"1024\""), "<verp:servo_type", "4096 counts a turn");
  const TemporaryFile other("robot.sdf", mine("counts_per_rev=\"1024\" model_number=\"4711\""));
  EXPECT_NO_THROW(load_robot(other.path()));

  expect_refused(with("", "1234567"), "<verp:bus", "no such Baud Rate");
  std::string fast = with("", "4500000");
  const TemporaryFile fast_file("robot.sdf", fast);
  EXPECT_NO_THROW(load_robot(fast_file.path()));
  const std::string old_type = "type=\"xm430_w210\"";
  for (auto from = fast.find(old_type); from != std::string::npos; from = fast.find(old_type)) {
    fast.replace(from, old_type.size(), "type=\"xl330\"");
  }
  expect_refused(fast, "<verp:bus", "servo type 'xl330' has no such Baud Rate");
}

// Random robots vary unmeasured numbers.
TEST(BadInput, AServoTypeThatIsLikeAnotherIsAsSureAsItsNumbers) {
  const std::string old_type = "type=\"xm430_w210\"";
  const auto mine = [&](const std::string& attributes) {
    std::string text = edited("<verp:bus name=\"dxl\"",
                              "<verp:servo_type name=\"mine\" like=\"xm430_w210\" " + attributes +
                                  " source=\"my bench\"/>\n    <verp:bus name=\"dxl\"");
    for (auto from = text.find(old_type); from != std::string::npos; from = text.find(old_type))
      text.replace(from, old_type.size(), "type=\"mine\"");
    const TemporaryFile file("robot.sdf", text);
    return load_robot(file.path()).joints.front().servo;
  };
  const Servo rotor = mine("armature_kg_m2=\"0.02\"");
  EXPECT_EQ(rotor.armature_band, 0);
  EXPECT_EQ(rotor.friction_band, 0.5);
  EXPECT_EQ(rotor.source.rfind("my bench; friction scaled", 0), 0u) << rotor.source;
  const Servo friction = mine("f_base_n_m=\"0.1\"");
  EXPECT_EQ(friction.armature_band, 0.5);
  EXPECT_EQ(friction.friction_band, 0);
  EXPECT_EQ(friction.source.rfind("my bench; rotor scaled", 0), 0u) << friction.source;
}

}  // namespace
}  // namespace verp::model
