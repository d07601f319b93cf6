#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "host/model/load.hpp"
#include "tests/host/model/test_files.hpp"

/// Files as other people write them, each with one fault that crashed the loader or passed it: the
/// refusal names the file and a line within five of the fault.
namespace verp::model {
namespace {

constexpr const char* kLimit = R"(<limit lower="-1" upper="1" effort="1" velocity="1"/>)";

std::string urdf_link(const std::string& name) {
  return "<link name=\"" + name +
         "\"><inertial><mass value=\"1\"/>\n"
         "<inertia ixx=\"0.001\" iyy=\"0.001\" izz=\"0.001\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>"
         "</inertial></link>\n";
}

std::string urdf_joint(const std::string& name, const std::string& inside,
                       const std::string& type = "revolute") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\">\n" + inside +
         "<axis xyz=\"0 0 1\"/></joint>\n";
}

std::string hung(const std::string& parent, const std::string& child) {
  return "<parent link=\"" + parent + "\"/><child link=\"" + child + "\"/>";
}

std::string sdf_of(const std::string& inside, const std::string& root =
                                                  "<sdf version=\"1.9\" "
                                                  "xmlns:verp=\"https://verp.dev/sdf/1\">") {
  return root + "\n<model name=\"small\">\n" + inside +
         "\n<verp:body link=\"a\"/>\n<verp:bus protocol=\"dynamixel2\">\n"
         "<verp:servo joint=\"j\" id=\"1\" type=\"mx28\"/>\n</verp:bus>\n</model>\n</sdf>\n";
}

std::string sdf_link(const std::string& name) {
  return "<link name=\"" + name +
         "\"><inertial><mass>1</mass><inertia><ixx>0.001</ixx><iyy>0.001</iyy><izz>0.001</izz>"
         "</inertia></inertial></link>\n";
}

int line_of(const std::string& text, const std::string& part) {
  const auto at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

/// The error that `load` ends in. Its own time is bounded: what never ends is found by ctest.
LoadError refusal(const std::string& path) {
  try {
    load_robot(path);
  } catch (const LoadError& error) {
    EXPECT_FALSE(error.fix.empty());
    return error;
  }
  ADD_FAILURE() << "was accepted";
  return {path, 0, "", ""};
}

void expect_sdf_refused(const std::string& text, const std::string& fault,
                        const std::string& said) {
  const TemporaryFile file("robot.sdf", text);
  const LoadError error = refusal(file.path());
  EXPECT_EQ(error.file, file.path());
  EXPECT_NE(error.message.find(said), std::string::npos) << error.what();
  EXPECT_NEAR(error.line, line_of(text, fault), 5) << error.what();
}

void expect_urdf_refused(const std::string& inside, const std::string& fault,
                         const std::string& said) {
  std::string text = "<robot name=\"small\">\n" + urdf_link("a") + urdf_link("b");
  // Far from the file's beginning, so that naming its first line is no luck.
  for (int i = 0; i < 20; ++i) text += "<!-- servos and gears -->\n";
  text += inside + "</robot>\n";
  const TemporaryFile urdf("small.urdf", text);
  const std::string name = std::filesystem::path(urdf.path()).filename().string();
  const TemporaryFile file("robot.sdf",
                           sdf_of("<include merge=\"true\"><uri>" + name + "</uri></include>"));
  const LoadError error = refusal(file.path());
  EXPECT_TRUE(std::filesystem::equivalent(error.file, urdf.path())) << error.what();
  EXPECT_NE(error.message.find(said), std::string::npos) << error.what();
  EXPECT_NEAR(error.line, line_of(text, fault), 5) << error.what();
}

TEST(OthersFiles, RevoluteJointWithoutAnAxisIsRefused) {
  const std::string joint =
      "<joint name=\"j\" type=\"revolute\">\n<parent>a</parent><child>b"
      "</child></joint>\n";
  expect_sdf_refused(sdf_of(sdf_link("a") + sdf_link("b") + joint), "<joint name=\"j\"", "axis");
}

TEST(OthersFiles, FileThatIncludesItselfIsRefused) {
  const std::string folder = ::testing::TempDir();
  const std::string path = folder + "/includes_itself.sdf";
  std::ofstream(path) << sdf_of("<include><uri>includes_itself.sdf</uri></include>");
  const LoadError error = refusal(path);
  EXPECT_NE(error.message.find("includes itself"), std::string::npos) << error.what();
  EXPECT_EQ(error.line, 3);
}

TEST(OthersFiles, TwoThatIncludeEachOtherAreRefused) {
  const std::string folder = ::testing::TempDir();
  std::ofstream(folder + "/ping.sdf") << sdf_of("<include><uri>pong.sdf</uri></include>");
  std::ofstream(folder + "/pong.sdf") << sdf_of("<include><uri>ping.sdf</uri></include>");
  const LoadError error = refusal(folder + "/ping.sdf");
  EXPECT_NE(error.message.find("includes itself"), std::string::npos) << error.what();
  EXPECT_TRUE(error.file.ends_with("pong.sdf")) << error.what();
}

// Each file includes the next one twice: 2^20 readings of the last.
TEST(OthersFiles, FilesThatMultiplyAreRefusedAtOnce) {
  const std::string folder = ::testing::TempDir();
  for (int i = 0; i < 20; ++i) {
    const std::string next =
        i == 19 ? "" : "<include><uri>multiply" + std::to_string(i + 1) + ".sdf</uri></include>\n";
    std::ofstream(folder + "/multiply" + std::to_string(i) + ".sdf") << sdf_of(next + next);
  }
  const LoadError error = refusal(folder + "/multiply0.sdf");
  EXPECT_NE(error.message.find("files are included"), std::string::npos) << error.what();
}

TEST(OthersFiles, NumbersForGazeboAreNumbers) {
  expect_urdf_refused(urdf_joint("j", hung("a", "b") + kLimit) +
                          "<gazebo reference=\"b\"><mu1>abc</mu1></gazebo>\n",
                      "<mu1>abc", "<mu1> is not a finite number: 'abc'");
}

TEST(OthersFiles, ForeignOrMissingNamespaceIsRefused) {
  const std::string links = sdf_link("a");
  expect_sdf_refused(sdf_of(links, "<sdf version=\"1.9\">"), "<sdf", "xmlns:verp is missing");
  expect_sdf_refused(sdf_of(links, "<sdf version=\"1.9\" xmlns:verp=\"http://example.org/x\">"),
                     "<sdf", "example.org");
}

TEST(OthersFiles, SdfOfAnotherVersionIsRefused) {
  for (const char* version : {"9.9", "0.3", "two"}) {
    expect_sdf_refused(sdf_of(sdf_link("a"), "<sdf version=\"" + std::string(version) +
                                                 "\" xmlns:verp=\"https://verp.dev/sdf/1\">"),
                       "<sdf", std::string("SDF ") + version);
  }
}

TEST(OthersFiles, WhatIsGivenTwiceIsRefused) {
  std::string text = read_text(robot_file("generic21"));
  const auto mass = text.find("<mass>1.1</mass>");
  ASSERT_NE(mass, std::string::npos);
  std::string twice = text;
  twice.insert(mass, "<mass>1.2</mass>");
  expect_sdf_refused(twice, "<mass>1.2</mass>", "<mass> is given twice");
  const auto body = text.find("<verp:body");
  ASSERT_NE(body, std::string::npos);
  text.insert(body,
              "<verp:tuning name=\"gait.lift_m\" value=\"0.01\"/>\n"
              "<verp:tuning name=\"gait.lift_m\" value=\"0.02\"/>\n");
  expect_sdf_refused(text, "value=\"0.02\"", "'gait.lift_m' is given twice");
}

TEST(OthersFiles, UrdfWithoutALimitIsRefusedAtItsJoint) {
  expect_urdf_refused(urdf_joint("j", hung("a", "b")), "<joint name=\"j\"", "limits");
  expect_urdf_refused(urdf_joint("j", hung("a", "b") + "<limit lower=\"0\" upper=\"1\"/>"),
                      "<joint name=\"j\"", "no effort");
}

TEST(OthersFiles, UrdfWithDuplicatesIsRefusedAtTheSecond) {
  const std::string joint = urdf_joint("j", hung("a", "b") + kLimit);
  expect_urdf_refused(joint + "<link name=\"b\" />\n", "<link name=\"b\" />", "'b' is given twice");
  expect_urdf_refused(joint + "<joint name=\"j\" type=\"fixed\">" + hung("a", "b") + "</joint>\n",
                      "type=\"fixed\"", "'j' is given twice");
}

TEST(OthersFiles, UrdfThatIsNoTreeIsRefusedWithTheCause) {
  expect_urdf_refused(urdf_joint("j", hung("zz", "b") + kLimit), "<joint name=\"j\"", "[zz]");
  expect_urdf_refused("<link name=\"alone\"/>\n" + urdf_joint("j", hung("a", "b") + kLimit),
                      "<link name=\"alone\"", "two root links");
}

TEST(OthersFiles, UrdfJointOfAnUnknownTypeIsRefused) {
  expect_urdf_refused(urdf_joint("j", hung("a", "b") + kLimit, "hinge"), "<joint name=\"j\"",
                      "[hinge]");
}

}  // namespace
}  // namespace verp::model
