#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "host/author/mjcf/mjcf.hpp"
#include "host/os/files/temporary_directory.hpp"

namespace verp::mjcf {
namespace {

/// A knee that a motor beside it turns through a rod, and a hip behind a gear of a half.
constexpr const char* kThigh = R"(<mujoco><default><geom size="0.01"/></default><worldbody>
<body name="thigh"><geom/>
 <body name="horn"><joint name="knee_motor" armature="0.001"/><geom/>
  <body name="rod" pos="0.02 0 0"><joint name="rod_end"/><geom/></body></body>
 <body name="calf" pos="0 0 -0.1"><joint name="knee" armature="0.0002"/><geom/>
  <body name="pin" pos="0.02 0 0"><joint name="pin"/><geom/></body>
  <body name="foot" pos="0 0 -0.1"><joint name="ankle"/><geom/></body></body>
 <body name="gear"><joint name="hip_motor" damping="0.1" armature="0.003"/><geom/></body>
 <body name="hip"><joint name="hip"/><geom/><body name="other"><geom/></body></body>
</body></worldbody>
<actuator><motor joint="knee_motor" ctrlrange="-3 3"/><motor joint="hip_motor" ctrlrange="-2 2"/>
 <motor joint="ankle" ctrlrange="-1 1"/></actuator>
<equality><weld body1="rod" body2="pin"/>
 <joint joint1="hip" joint2="hip_motor" polycoef="0 -0.5 0 0 0"/></equality></mujoco>)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kThigh;
  return text.replace(text.find(from), from.size(), to);
}

Robot read(const std::string& text) {
  const files::TemporaryDirectory folder;
  const auto file = folder.path() / "thigh.xml";
  std::ofstream(file) << text;
  return read_robot(file.string());
}

Motor motor_of(const Robot& robot, const std::string& name) {
  for (const Body& body : robot.bodies) {
    for (const Joint& joint : body.joints) {
      if (joint.name == name) return joint.motor;
    }
  }
  ADD_FAILURE() << "no joint " << name;
  return {};
}

TEST(Transmission, MotorsBesideAJointAreTheJointsAndThisIsSaid) {
  const Robot robot = read(kThigh);
  const auto motor = [&](const std::string& name) { return motor_of(robot, name); };
  EXPECT_DOUBLE_EQ(motor("knee").torque_n_m, 3);
  EXPECT_NEAR(motor("knee").armature_kg_m2, 0.0012, 1e-9);
  EXPECT_DOUBLE_EQ(motor("hip").torque_n_m, 4);
  EXPECT_NEAR(motor("hip").armature_kg_m2, 0.012, 1e-9);
  EXPECT_DOUBLE_EQ(motor("hip").damping_n_m_s, 0.4);
  EXPECT_DOUBLE_EQ(motor("ankle").torque_n_m, 1);
  for (const char* const name : {"knee_motor", "hip_motor", "rod_end", "pin"})
    EXPECT_FALSE(motor(name).has_actuator) << name;
  EXPECT_TRUE(robot.followers.empty());
  for (const char* const line :
       {"the motor of joint knee_motor turns joint knee through rods: 1 to 1 is a guess",
        "the motor of joint hip_motor turns joint hip by a gear of 0.5"}) {
    EXPECT_EQ(std::count(robot.left_out.begin(), robot.left_out.end(), line), 1) << line;
  }
}

TEST(Transmission, RodsMayMeetAtSites) {
  std::string text =
      with("<weld body1=\"rod\" body2=\"pin\"/>", "<connect site1=\"a\" site2=\"b\"/>");
  for (const auto& [joint, site] : {std::pair{"rod_end", "a"}, {"pin", "b"}}) {
    const std::string at = std::string("<joint name=\"") + joint + "\"/>";
    text.insert(text.find(at), std::string("<site name=\"") + site + "\"/>");
  }
  EXPECT_DOUBLE_EQ(motor_of(read(text), "knee").torque_n_m, 3);
}

TEST(Transmission, ForceOfASlidingMotorIsNoTorque) {
  const Robot robot =
      read(with("<joint name=\"knee_motor\"", "<joint name=\"knee_motor\" type=\"slide\""));
  EXPECT_FALSE(motor_of(robot, "knee").has_actuator);
}

}  // namespace
}  // namespace verp::mjcf
