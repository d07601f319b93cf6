#include <gtest/gtest.h>

#include <string>

#include "host/robot/model/load.hpp"
#include "tests/host/model/bad_input.hpp"

namespace verp::model {
namespace {

TEST(BadInput, MissingFileIsRefused) {
  try {
    load_robot("/nowhere/robot.sdf");
    FAIL();
  } catch (const LoadError& error) {
    EXPECT_EQ(std::string(error.what()),
              "/nowhere/robot.sdf:1: cannot read this file; check the path and its permissions");
  }
}

TEST(BadInput, UnknownNameListsTheRobotsThereAre) {
  try {
    find_model("generic22");
    FAIL();
  } catch (const LoadError& error) {
    EXPECT_NE(error.fix.find("generic21"), std::string::npos) << error.what();
  }
}

TEST(BadInput, MalformedXmlIsRefusedAtItsLine) {
  expect_refused(edited("<mass>1.1</mass>", "<mass>1.1</mas>"), "<mass>1.1</mas>", "malformed XML");
}

// tinyxml2 and libsdformat accept them; xmllint, expat and Python do not.
TEST(BadInput, CommentThatIsNotWellFormedIsRefusedAtItsLine) {
  for (const char* comment : {"<!-- first line\n  for --bus can -->", "<!-- dash --->"}) {
    const std::string part = std::string(comment).find("--bus") != std::string::npos
                                 ? "for --bus can"
                                 : "<!-- dash --->";
    expect_refused(edited("<mass>1.1</mass>", std::string(comment) + "<mass>1.1</mass>"), part,
                   "two hyphens");
  }
}

TEST(BadInput, FileThatEndsEarlyIsRefused) {
  const std::string whole = read_text(robot_file("generic21"));
  const TemporaryFile file("robot.sdf", whole.substr(0, whole.size() / 2));
  EXPECT_THROW(load_robot(file.path()), LoadError);
}

TEST(BadInput, EmptyFileIsRefused) {
  const TemporaryFile file("robot.sdf", "");
  EXPECT_THROW(load_robot(file.path()), LoadError);
}

TEST(BadInput, NumberWithDecimalCommaIsRefused) {
  expect_refused(edited("<mass>1.1</mass>", "<mass>1,0x</mass>"), "<mass>1,0x</mass>", "'1,0x'");
}

TEST(BadInput, NanIsRefused) {
  expect_refused(edited("<mass>1.1</mass>", "<mass>nan</mass>"), "<mass>nan</mass>", "finite");
  expect_refused(edited("<mass>1.1</mass>", "<mass></mass>"), "<mass></mass>", "finite");
  expect_refused(edited("<mass>1.1</mass>", "<mass/>"), "<mass/>", "finite");
  expect_refused(edited("value=\"0.147301\"", "value=\"nan\""), "value=\"nan\"", "finite");
}

TEST(BadInput, TooFewNumbersInAPoseAreRefused) {
  expect_refused(edited("<xyz>0 0 1</xyz>", "<xyz>0 1</xyz>"), "<xyz>0 1</xyz>",
                 "3 finite numbers");
}

TEST(BadInput, DuplicateServoIdIsRefused) {
  expect_refused(edited("joint=\"l_knee\" id=\"14\"", "joint=\"l_knee\" id=\"8\""),
                 "joint=\"l_knee\" id=\"8\"", "bus id 8 is used twice");
}

TEST(BadInput, ReservedIdIsRefused) {
  expect_refused(edited("joint=\"l_knee\" id=\"14\"", "joint=\"l_knee\" id=\"200\""),
                 "joint=\"l_knee\" id=\"200\"", "from 1 to 199");
}

TEST(BadInput, JointWithoutServoIsRefusedAtTheJoint) {
  std::string text = read_text(robot_file("generic21"));
  const auto start = text.find("      <verp:servo joint=\"l_knee\"");
  ASSERT_NE(start, std::string::npos);
  text.erase(start, text.find('\n', start) + 1 - start);
  expect_refused(text, "<joint name=\"l_knee\"", "joint 'l_knee' has no servo");
}

TEST(BadInput, ServoForNoJointIsRefused) {
  expect_refused(edited("<verp:servo joint=\"l_knee\"", "<verp:servo joint=\"left_knee\""),
                 "<verp:servo joint=\"left_knee\"", "no moving joint 'left_knee'");
}

TEST(BadInput, UnknownServoTypeListsTheTypes) {
  expect_refused(edited("type=\"xm430_w210\"", "type=\"ax12\""), "type=\"ax12\"",
                 "xm430_w210, xm430_w350, xh430_w210");
}

TEST(BadInput, LegThatStartsBelowItsFirstJointIsRefused) {
  const std::string text =
      edited("<verp:limb name=\"left_leg\" base=\"trunk\" tip=\"l_sole\"/>",
             "<verp:limb name=\"left_leg\" base=\"l_hip_yaw_link\" tip=\"l_sole\"/>");
  expect_refused(text, "<verp:limb name=\"left_leg\"", "left_leg has 5 joints");
}

TEST(BadInput, LegWithoutHipRollIsRefused) {
  std::string text = edited("<joint name=\"l_hip_roll\" type=\"revolute\">",
                            "<joint name=\"l_hip_roll\" type=\"fixed\">");
  const auto start = text.find("      <verp:servo joint=\"l_hip_roll\"");
  text.erase(start, text.find('\n', start) + 1 - start);
  expect_refused(text, "<verp:limb name=\"left_leg\"", "left_leg has 5 joints");
}

TEST(BadInput, MasslessLinkIsRefused) {
  std::string text = read_text(robot_file("generic21"));
  const auto link = text.find("<link name=\"l_thigh\">");
  const auto start = text.find("<inertial>", link);
  const std::string end = "</inertial>";
  text.erase(start, text.find(end, start) + end.size() - start);
  expect_refused(text, "<link name=\"l_thigh\">", "link 'l_thigh' has no <inertial>");
}

TEST(BadInput, ImpossibleInertiaIsRefused) {
  expect_refused(edited("<ixx>0.00366667</ixx>", "<ixx>-0.00366667</ixx>"), "<link name=\"trunk\">",
                 "inertia");
  expect_refused(edited("<ixx>0.00366667</ixx>", "<ixx>0.1</ixx>"), "<link name=\"trunk\">",
                 "inertia");
}

TEST(BadInput, InertiaInOtherUnitsIsRefused) {
  expect_refused(edited("<ixx>0.00366667</ixx><iyy>0.00293333</iyy><izz>0.00190667</izz>",
                        "<ixx>3.66667</ixx><iyy>2.93333</iyy><izz>1.90667</izz>"),
                 "<link name=\"trunk\">", "radius of gyration");
}

TEST(BadInput, NegativeMassIsRefused) {
  expect_refused(edited("<mass>1.1</mass>", "<mass>-1.1</mass>"), "<mass>-1.1</mass>", "mass");
}

TEST(BadInput, AbsurdMagnitudesAreRefused) {
  const struct {
    const char *old_part, *new_part, *line_part, *message;
  } kRows[] = {
      {"<mass>1.1</mass>", "<mass>1e30</mass>", "<mass>1e30", "give 0 to 1000 kg"},
      {"<mass>1.1</mass>", "<mass>1e-30</mass>", "<link name=\"trunk\">", "milligram"},
      {"<ixx>0.00366667</ixx>", "<ixx>1e30</ixx>", "<ixx>1e30", "100000 kg m2"},
      {"<ixx>0.00366667</ixx><iyy>0.00293333</iyy><izz>0.00190667</izz>",
       "<ixx>1e-30</ixx><iyy>1e-30</iyy><izz>1e-30</izz>", "<link name=\"trunk\">", "that dense"},
      {"<pose>0 0 0.003 0 0 0</pose>", "<pose>0 0 1e30 0 0 0</pose>", "1e30", "-10 to 10 m"},
      {"<pose>0 0 0.003 0 0 0</pose>", "<pose>0 0 0 1e30 0 0</pose>", "1e30", "-1000 to 1000"},
      {"<xyz>0 0 1</xyz>", "<xyz>0 0 1e30</xyz>", "1e30", "-1000 to 1000"},
      {"<size>", "<size>1e30 ", "<size>1e30", "0 to 10 m"},
      {"<mu>0.8</mu>", "<mu>1e30</mu>", "<mu>1e30", "0 to 100"},
      {"<kp>50000</kp>", "<kp>0</kp>", "<kp>0<", "1 to 1e+12 N/m"},
      {"<kd>500</kd>", "<kd>1e30</kd>", "<kd>1e30", "N s/m"},
      {"<upper>1</upper>", "<upper>1e30</upper>", "<joint name=\"head_pitch\"",
       "no position limits"},
      {"<upper>1</upper>", "<upper>1</upper><velocity>1e-30</velocity>",
       "<joint name=\"head_pitch\"", "hardly move"},
      {"<upper>1</upper>", "<upper>1</upper><velocity>nan</velocity>", "nan", "finite"},
      {"<upper>1</upper>", "<upper>1</upper><effort>1,0x</effort>", "1,0x", "finite"},
      {"<verp:body link=\"trunk\"/>",
       "<verp:body link=\"trunk\"><pose>1e30 0 0 0 0 0</pose></verp:body>", "1e30", "-10 to 10"},
      {"newton_per_count=\"0.01\"", "newton_per_count=\"1e30\"", "1e30", "1e-06 to 10 N"},
      {"newton_per_count=\"0.01\"", "newton_per_count=\"0\"", "count=\"0\"", "1e-06 to 10 N"},
      {"baud=\"2000000\"", "baud=\"1e30\"", "1e30", "9600 to 4500000"},
      {"baud=\"2000000\"", "baud=\"9600\"", "baud=\"9600\"", "raise baud"},
      {"period_us=\"10000\"", "period_us=\"1\"", "period_us=\"1\"", "4000 to 20000"},
  };
  for (const auto& row : kRows) {
    SCOPED_TRACE(row.new_part);
    expect_refused(edited(row.old_part, row.new_part), row.line_part, row.message);
  }
}

TEST(BadInput, LimitsThatMayBeEndlessStayAllowed) {
  const TemporaryFile file("robot.sdf",
                           edited("<upper>1</upper>", "<upper>1</upper><velocity>inf</velocity>"));
  EXPECT_NO_THROW(load_robot(file.path()));
}

TEST(BadInput, InvertedLimitsAreRefused) {
  expect_refused(
      edited("<lower>-0.6</lower><upper>1</upper>", "<lower>1</lower><upper>-0.6</upper>"),
      "<joint name=\"head_pitch\"", "lower limit");
}

TEST(BadInput, MissingLimitsAreRefused) {
  expect_refused(edited("<limit><lower>-0.6</lower><upper>1</upper></limit>", ""),
                 "<joint name=\"head_pitch\"", "no position limits");
}

TEST(BadInput, LimitBeyondTheServosTurnIsRefused) {
  expect_refused(
      edited("<lower>-0.6</lower><upper>1</upper>", "<lower>-0.6</lower><upper>4</upper>"),
      "<joint name=\"head_pitch\"", "single turn");
}

TEST(BadInput, LinkAndJointOfOneNameAreRefused) {
  std::string text = read_text(robot_file("generic21"));
  for (std::size_t at = text.find("\"neck\""); at != std::string::npos;
       at = text.find("\"neck\"", at)) {
    text.replace(at, 6, "\"head_yaw\"");
  }
  const TemporaryFile file("robot.sdf", text);
  try {
    load_robot(file.path());
    FAIL();
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("head_yaw"), std::string::npos) << error.what();
  }
}

TEST(BadInput, UnknownElementsAreRefused) {
  expect_refused(edited("<verp:feet ", "<verp:foot "), "<verp:foot ",
                 "unknown element <verp:foot>");
  expect_refused(edited("<mass>1.1</mass>", "<mass>1.1</mass><weight>3</weight>"), "<weight>",
                 "weight");
}

TEST(BadInput, WhatNobodyReadsInsideOfAnElementIsRefused) {
  const std::string tuning = "<verp:tuning name=\"gait.lift_m\" value=\"0.01\">";
  const auto with = [&](const std::string& inside) {
    return edited("<verp:feet ", tuning + inside + "</verp:tuning><verp:feet ");
  };
  expect_refused(with("<why/>"), "<why/>", "unknown element <why> in <verp:tuning>");
  expect_refused(with("0.02"), tuning, "has text inside, '0.02'");
  expect_refused(with("<!-- measured -->\n 0.02\n or less\n"), tuning, "has text inside, '0.02'");
}

TEST(BadInput, VerpElementInTheWrongPlaceIsRefused) {
  expect_refused(
      edited("<parent>trunk</parent>", "<parent>trunk</parent><verp:servo joint=\"x\"/>"),
      "<verp:servo joint=\"x\"/>", "verp:servo");
}

TEST(BadInput, UnknownAttributeIsRefused) {
  expect_refused(edited("backlash_rad=", "backlash="), "backlash=", "no attribute 'backlash'");
}

TEST(BadInput, TuningOutsideItsRangeIsRefused) {
  expect_refused(edited("value=\"0.147301\"", "value=\"15\""), "value=\"15\"", "out of range");
  expect_refused(edited("gait.hip_height_m", "gait.hip_hight_m"), "gait.hip_hight_m",
                 "no tuning value");
}

TEST(BadInput, PoseBeyondALimitIsRefused) {
  expect_refused(edited("name=\"l_knee\" rad=\"1.31363\"", "name=\"l_knee\" rad=\"-1\""),
                 "name=\"l_knee\" rad=\"-1\"", "outside its limits");
}

TEST(BadInput, BodyThatIsNotTheRootIsRefused) {
  expect_refused(edited("<verp:body link=\"trunk\"/>", "<verp:body link=\"skull\"/>"),
                 "<verp:body link=\"skull\"/>", "hangs on joint");
}

TEST(BadInput, LimbToNowhereIsRefused) {
  expect_refused(edited("tip=\"l_sole\"", "tip=\"l_shoe\""), "tip=\"l_shoe\"",
                 "no link or frame 'l_shoe'");
}

TEST(BadInput, SoleAboveTheFloorIsRefused) {
  expect_refused(
      edited("<pose>0 0 -0.0335 0 0 0</pose></frame>", "<pose>0 0 -0.01 0 0 0</pose></frame>"),
      "<verp:limb name=\"left_leg\"", "sole's plane");
}

TEST(BadInput, LoopOfLinksIsRefused) {
  expect_refused(edited("<parent>neck</parent>", "<parent>skull</parent>"),
                 "<link name=\"head_cross\">", "not connected to 'trunk'");
}

TEST(BadInput, BareUrdfIsRefusedWithAdvice) {
  const TemporaryFile file("robot.urdf", "<robot name=\"x\"><link name=\"a\"/></robot>");
  try {
    load_robot(file.path());
    FAIL();
  } catch (const LoadError& error) {
    EXPECT_NE(error.fix.find("`verp import FILE`"), std::string::npos) << error.what();
  }
}

TEST(BadInput, MissingThirdPartyFileNamesTheVariable) {
  const TemporaryFile file("robot.sdf",
                           "<sdf version=\"1.9\"><model name=\"m\">\n<include merge=\"true\">"
                           "<uri>model://no_such/robot.urdf</uri></include></model></sdf>");
  try {
    load_robot(file.path());
    FAIL();
  } catch (const LoadError& error) {
    EXPECT_EQ(error.line, 2);
    EXPECT_NE(error.fix.find("VERP_MODEL_PATH"), std::string::npos) << error.what();
  }
}

TEST(BadInput, CamerasThatCannotBeAreRefused) {
  const std::string line = "<sensor name=\"camera\"";
  const auto refused = [&](const std::string& was, const std::string& is, const std::string& why) {
    expect_refused(edited(was, is), line, why);
  };
  refused("<width>320</width>", "<width>4</width>", "<image>");
  for (const char* width : {"3.2e2", "320.5"}) {
    const std::string is = std::string("<width>") + width + "</width>";
    expect_refused(edited("<width>320</width>", is), is, "not a whole number");
  }
  refused("<near>0.02</near>", "<near>30</near>", "<clip>");
  refused("<horizontal_fov>1.0472</horizontal_fov>", "<horizontal_fov>3.1</horizontal_fov>",
          "<horizontal_fov>");
  refused("<far>20</far></clip>", "<far>20</far></clip><distortion><k1>-4</k1></distortion>",
          "folds the picture");
  refused("<far>20</far></clip>",
          "<far>20</far></clip><noise><type>gaussian</type><stddev>7</stddev></noise>", "<noise>");
  refused("<far>20</far></clip>",
          "<far>20</far></clip><lens><intrinsics><fx>0</fx><fy>280</fy><cx>160</cx><cy>120</cy>"
          "<s>0</s></intrinsics></lens>",
          "<intrinsics>");
  refused("<update_rate>30</update_rate>", "<update_rate>-1</update_rate>", "<update_rate>");
}

}  // namespace
}  // namespace verp::model
