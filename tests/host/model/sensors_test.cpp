#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "host/robot/model/check.hpp"
#include "host/robot/model/load.hpp"
#include "tests/host/model/test_files.hpp"

namespace verp::model {
namespace {

struct Additions {
  std::string joint, foot, elements;
};
std::string with_sensors(const Additions& add) {
  std::string text = read_text(robot_file("generic21"));
  const auto put = [&](const std::string& before, const std::string& what) {
    const auto at = text.find(before);
    EXPECT_NE(at, std::string::npos) << before;
    if (at != std::string::npos) text.insert(at, what);
  };
  put("<verp:body", add.elements);
  put("<sensor name=\"l_foot_front_left\"", add.foot);
  const auto joint = text.find("<child>l_foot</child>");
  EXPECT_NE(joint, std::string::npos);
  text.insert(text.find("</joint>", joint), add.joint);
  return text;
}

Entity loaded(const Additions& add) {
  const TemporaryFile file("robot.sdf", with_sensors(add));
  return load_robot(file.path());
}

void expect_bad_sensor(const Additions& add, const std::string& line_part,
                       const std::string& words) {
  const std::string text = with_sensors(add);
  const TemporaryFile file("robot.sdf", text);
  const auto at = text.find(line_part);
  ASSERT_NE(at, std::string::npos);
  try {
    load_robot(file.path());
    FAIL() << "was accepted; should mention " << words;
  } catch (const LoadError& error) {
    EXPECT_EQ(error.line, 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'))
        << error.what();
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    EXPECT_FALSE(error.fix.empty());
  }
}

const char* const kAnkle =
    "<sensor name=\"ankle\" type=\"force_torque\"><update_rate>200</update_rate><force_torque>"
    "<frame>sensor</frame><measure_direction>parent_to_child</measure_direction>"
    "<force><z><noise type=\"gaussian\"><mean>0.5</mean><stddev>0.25</stddev></noise></z></force>"
    "</force_torque></sensor>\n";
const char* const kSole =
    "<sensor name=\"sole\" type=\"contact\"><update_rate>50</update_rate><topic>/left/sole</topic>"
    "<contact><collision>l_foot_box</collision></contact></sensor>\n";

TEST(Sensors, AreReadWithTheirRatesNoiseAndLatency) {
  const Entity e = loaded(
      {kAnkle, kSole,
       "<verp:truth name=\"truth\" link=\"l_foot\" rate_hz=\"25\" position_noise_m=\"0.001\" "
       "latency_s=\"0.01\"><pose>0 0 -0.0335 0 0 0</pose></verp:truth>\n"
       "<verp:latency sensor=\"ankle\" s=\"0.004\"/>\n<verp:latency sensor=\"camera\" "
       "s=\"0.05\"/>\n<verp:latency sensor=\"laser\" s=\"0.1\"/>\n"});
  ASSERT_EQ(e.force_torques.size(), 1u);
  const ForceTorqueSensor& ankle = e.force_torques[0];
  EXPECT_EQ(e.nodes[static_cast<std::size_t>(ankle.node)].name, "l_foot");
  EXPECT_EQ(ankle.rate_hz, 200);
  EXPECT_EQ(ankle.latency_s, 0.004);
  EXPECT_TRUE(ankle.on_child);
  EXPECT_EQ(ankle.force_mean_n, Vec3(0, 0, 0.5));
  EXPECT_EQ(ankle.force_stddev_n, Vec3(0, 0, 0.25));
  ASSERT_EQ(e.contacts.size(), 1u) << "the force cells have no topic";
  EXPECT_EQ(e.contacts[0].topic, "left/sole");
  EXPECT_EQ(e.contacts[0].rate_hz, 50);
  ASSERT_EQ(e.truths.size(), 1u);
  EXPECT_EQ(e.truths[0].node, ankle.node);
  EXPECT_EQ(e.truths[0].rate_hz, 25);
  EXPECT_EQ(e.truths[0].latency_s, 0.01);
  EXPECT_EQ(e.cameras.at(0).latency_s, 0.05);
  EXPECT_EQ(e.lasers.at(0).latency_s, 0.1);
  EXPECT_EQ(e.imu->latency_s, 0);
  const std::string text = describe(e);
  EXPECT_NE(text.find("force_torque on l_foot (4 ms late)"), std::string::npos) << text;
  EXPECT_NE(text.find("camera on skull (50 ms late)"), std::string::npos) << text;
  EXPECT_NE(text.find("truth 'truth' of l_foot (10 ms late)"), std::string::npos) << text;
  EXPECT_NE(describe_json(e).find("\"latency_s\": 0.004"), std::string::npos);
}

TEST(Sensors, WhereNoneIsAddedNothingIsLate) {
  const Entity e = load_robot(robot_file("generic21"));
  EXPECT_TRUE(e.force_torques.empty());
  EXPECT_TRUE(e.contacts.empty());
  EXPECT_TRUE(e.truths.empty());
  EXPECT_EQ(e.lasers.at(0).latency_s, 0);
  EXPECT_EQ(describe(e).find("late)"), std::string::npos);
}

TEST(Sensors, TheForcesAxesAreTheSensorsOrTheChilds) {
  const auto pose_with = [](const std::string& frame) {
    return loaded(
               {"<sensor name=\"ankle\" type=\"force_torque\"><pose>0 0 0.01 0 0 1.5707963</pose>"
                "<force_torque><frame>" +
                    frame + "</frame></force_torque></sensor>\n",
                "", ""})
        .force_torques.at(0);
  };
  EXPECT_NEAR(pose_with("sensor").pose.linear()(1, 0), 1, 1e-6);
  EXPECT_NEAR(pose_with("child").pose.linear()(0, 0), 1, 1e-6);
  EXPECT_NEAR(pose_with("child").pose.translation().z(), pose_with("sensor").pose.translation().z(),
              1e-12);
  EXPECT_FALSE(pose_with("child").on_child) << "SDF's default";
}

TEST(Sensors, AWrongLatencyIsRefused) {
  const auto bad = [](const std::string& words, const std::string& what) {
    const std::string element = "<verp:latency " + words + "/>\n";
    expect_bad_sensor({"", "", element}, element, what);
  };
  bad("sensor=\"camera\" s=\"-0.01\"", "-0.01");
  bad("sensor=\"camera\" s=\"30\"", "30");
  bad("sensor=\"camera\" s=\"nan\"", "s ");
  bad("sensor=\"camera\"", "s");
  bad("sensor=\"kamera\" s=\"0.03\"", "no sensor 'kamera'");
  bad("sensor=\"imu\" s=\"0.03\"", "<verp:imu>");
  bad("sensor=\"l_foot_front_left\" s=\"0.03\"", "that is sampled");
  const std::string twice = "<verp:latency sensor=\"laser\" s=\"0.02\"/>\n";
  expect_bad_sensor({"", "", "<verp:latency sensor=\"laser\" s=\"0.01\"/>\n" + twice}, twice,
                    "two latencies");
}

TEST(Sensors, TheImusLatencyStandsWithTheImu) {
  std::string text = read_text(robot_file("generic21"));
  const auto at = text.find("<verp:imu ");
  ASSERT_NE(at, std::string::npos);
  const auto with = [&](const std::string& value) {
    std::string changed = text;
    changed.insert(at + 10, "latency_s=\"" + value + "\" ");
    const TemporaryFile file("robot.sdf", changed);
    return load_robot(file.path()).imu->latency_s;
  };
  EXPECT_EQ(with("0.008"), 0.008);
  EXPECT_THROW(with("-0.008"), LoadError);
  EXPECT_THROW(with("8"), LoadError);
}

TEST(Sensors, WhatHasNoForceOrNoChannelIsRefused) {
  const std::string trunk =
      "<sensor name=\"trunk_load\" type=\"force_torque\"><force_torque/></sensor>\n";
  std::string text = read_text(robot_file("generic21"));
  text.insert(text.find("<sensor name=\"imu\""), trunk);
  const TemporaryFile file("trunk.sdf", text);
  EXPECT_THROW(load_robot(file.path()), LoadError);
  const std::string parent =
      "<sensor name=\"ankle\" type=\"force_torque\"><force_torque><frame>parent</frame>"
      "</force_torque></sensor>\n";
  expect_bad_sensor({parent, "", ""}, parent, "<frame>");
  expect_bad_sensor({"", "", "<verp:truth name=\"control\" link=\"l_foot\"/>\n"}, "<verp:truth",
                    "another channel is called /control");
  expect_bad_sensor({"", "", "<verp:truth name=\"a b\" link=\"l_foot\"/>\n"}, "<verp:truth",
                    "no name of a channel");
  expect_bad_sensor({"", "", "<verp:truth name=\"t\" link=\"nowhere\"/>\n"}, "<verp:truth",
                    "nowhere");
  expect_bad_sensor({"", "", "<verp:truth name=\"t\" link=\"l_foot\" rate_hz=\"0\"/>\n"},
                    "<verp:truth", "rate_hz");
  expect_bad_sensor({"", "", "<verp:truth name=\"t\" link=\"l_foot\" noise=\"1\"/>\n"},
                    "<verp:truth", "noise");
}

}  // namespace
}  // namespace verp::model
