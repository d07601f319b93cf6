#include "host/author/import/servos.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/robot/model/load_error.hpp"

namespace verp::import {
namespace {

constexpr Drive kKnee{.stall_torque_n_m = 130, .no_load_rad_s = 12, .armature_kg_m2 = 0.05};

const Finding* finding(const ServoChoice& choice, const std::string& part) {
  for (const Finding& each : choice.findings) {
    if (each.value.find(part) != std::string::npos) return &each;
  }
  return nullptr;
}

TEST(ServosOfAnImport, EqualDrivesShareAType) {
  const Drive ankle{.stall_torque_n_m = 50, .friction_n_m = 0.2};
  const ServoChoice choice = choose_servo_types(
      {{"left_knee", kKnee}, {"left_ankle", ankle}, {"right_knee", kKnee}}, "", 100);
  EXPECT_EQ(choice.types, (std::vector<std::string>{"motor_1", "motor_2", "motor_1"}));
  ASSERT_EQ(choice.own_types.size(), 2U);
  EXPECT_NE(choice.own_types[0].find("peak_torque_n_m=\"130\""), std::string::npos);
  EXPECT_NE(choice.own_types[0].find("armature_kg_m2=\"0.05\""), std::string::npos);
  EXPECT_EQ(choice.own_types[0].find("f_base_n_m"), std::string::npos);
  EXPECT_NE(choice.own_types[1].find("f_base_n_m=\"0.2\""), std::string::npos);
}

TEST(ServosOfAnImport, WhatADriveDoesNotSayIsNamedAsAGuess) {
  const ServoChoice choice =
      choose_servo_types({{"knee", kKnee}, {"neck", Drive{.stall_torque_n_m = 7}}}, "", 100);
  ASSERT_NE(finding(choice, "motor_1 of 130 N m for knee"), nullptr);
  EXPECT_EQ(finding(choice, "motor_1")->check, "its friction: a guess");
  EXPECT_EQ(finding(choice, "motor_2")->check, "its speed, rotor, friction: a guess");
}

TEST(ServosOfAnImport, JointsWithoutADriveKeepTheRuleOfTheWeakestServo) {
  const ServoChoice choice = choose_servo_types({{"knee", kKnee}, {"neck"}}, "", 5);
  EXPECT_EQ(choice.types, (std::vector<std::string>{"motor_1", "mx64"}));
  EXPECT_EQ(choose_servo_types({{"knee", kKnee}, {"neck"}}, "", 20).types[1], "motor");
}

TEST(ServosOfAnImport, DriveWithoutATorqueIsNone) {
  for (const double torque_n_m : {0.0, -3.0, std::nan("")}) {
    const Drive drive{.stall_torque_n_m = torque_n_m, .armature_kg_m2 = 0.01};
    EXPECT_EQ(choose_servo_types({{"knee", drive}}, "", 5).types[0], "mx64") << torque_n_m;
  }
}

TEST(ServosOfAnImport, AllMotorsHaveOneSupply) {
  const ServoChoice own = choose_servo_types({{"knee", kKnee}, {"neck"}}, "", 20);
  for (const std::string& type : own.own_types)
    EXPECT_NE(type.find("nominal_v=\"48\""), std::string::npos) << type;
  const ServoChoice mixed = choose_servo_types({{"knee", kKnee}, {"neck"}}, "", 5);
  EXPECT_EQ(mixed.own_types[0].find("nominal_v"), std::string::npos) << mixed.own_types[0];
}

TEST(ServosOfAnImport, WishedTypeIsForAllJoints) {
  const ServoChoice choice = choose_servo_types({{"knee", kKnee}, {"neck"}}, "xm430_w350", 100);
  EXPECT_EQ(choice.types, (std::vector<std::string>{"xm430_w350", "xm430_w350"}));
  EXPECT_TRUE(choice.own_types.empty());
  EXPECT_THROW(choose_servo_types({{"knee"}}, "ax12", 1), model::LoadError);
}

TEST(ServosOfAnImport, LimitsAreMotorsOnlyIfTheySuitTheRobotAndStrongerThanKnownServos) {
  const auto type = [](const Drive& limit, double needed_n_m) {
    return choose_servo_types({{"knee", {}, limit}}, "", needed_n_m).types[0];
  };
  constexpr Drive kStrong{.stall_torque_n_m = 60, .no_load_rad_s = 12};
  EXPECT_EQ(type(kStrong, 80), "motor_1");
  EXPECT_EQ(type(kStrong, 5), "mx64") << "twelve times what the robot needs";
  EXPECT_EQ(type(kStrong, 130), "motor") << "it could not stand";
  EXPECT_EQ(type({.stall_torque_n_m = 10, .no_load_rad_s = 12}, 8), "xh540_w270");
  EXPECT_EQ(type({.stall_torque_n_m = 60, .no_load_rad_s = 100}, 80), "motor");
  EXPECT_EQ(type({.stall_torque_n_m = 60, .no_load_rad_s = -1}, 80), "motor");
  EXPECT_EQ(choose_servo_types({{"knee", kKnee}, {"neck", {}, kStrong}}, "", 80).types[1], "motor")
      << "the file says its drives";
}

}  // namespace
}  // namespace verp::import
