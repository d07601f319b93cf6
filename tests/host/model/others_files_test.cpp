#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/model/test_files.hpp"

/// Third-party files with one fault each. The error must be within five lines of it.
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

void expect_sdf_refused(const std::string& text, const std::string& fault,
                        const std::string& said) {
  const TemporaryFile file("robot.sdf", text);
  const LoadError error = refusal_of(file.path());
  EXPECT_EQ(error.file, file.path());
  EXPECT_NE(error.message.find(said), std::string::npos) << error.what();
  EXPECT_NEAR(error.line, line_of(text, fault), 5) << error.what();
}

void expect_urdf_refused(const std::string& inside, const std::string& fault,
                         const std::string& said) {
  std::string text = "<robot name=\"small\">\n" + urdf_link("a") + urdf_link("b");
  for (int i = 0; i < 20; ++i) text += "<!-- servos and gears -->\n";
  text += inside + "</robot>\n";
  const TemporaryFile urdf("small.urdf", text);
  const std::string name = std::filesystem::path(urdf.path()).filename().string();
  const TemporaryFile file("robot.sdf",
                           sdf_of("<include merge=\"true\"><uri>" + name + "</uri></include>"));
  const LoadError error = refusal_of(file.path());
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
  const LoadError error = refusal_of(path);
  EXPECT_NE(error.message.find("includes itself"), std::string::npos) << error.what();
  EXPECT_EQ(error.line, 3);
}

TEST(OthersFiles, TwoThatIncludeEachOtherAreRefused) {
  const std::string folder = ::testing::TempDir();
  std::ofstream(folder + "/ping.sdf") << sdf_of("<include><uri>pong.sdf</uri></include>");
  std::ofstream(folder + "/pong.sdf") << sdf_of("<include><uri>ping.sdf</uri></include>");
  const LoadError error = refusal_of(folder + "/ping.sdf");
  EXPECT_NE(error.message.find("includes itself"), std::string::npos) << error.what();
  EXPECT_TRUE(error.file.ends_with("pong.sdf")) << error.what();
}

// libsdformat requests files by <uri> alone: the second part would get the first file.
TEST(OthersFiles, OneTextForTwoFilesIsRefused) {
  const std::string folder = ::testing::TempDir() + "/two_of_a_name";
  for (const char* each : {"/a", "/b"}) {
    std::filesystem::create_directories(folder + each);
    std::ofstream(folder + each + "/part.sdf")
        << sdf_of("<include merge=\"true\"><uri>more.sdf</uri></include>");
    std::ofstream(folder + each + "/more.sdf") << sdf_of(sdf_link(each + 1));
  }
  std::ofstream(folder + "/robot.sdf") << sdf_of(
      "<include merge=\"true\"><uri>a/part.sdf</uri></include>\n"
      "<include merge=\"true\"><uri>b/part.sdf</uri></include>");
  const LoadError error = refusal_of(folder + "/robot.sdf");
  EXPECT_NE(error.message.find("'more.sdf' is"), std::string::npos) << error.what();
  EXPECT_TRUE(error.file.ends_with("b/part.sdf")) << error.what();
}

// Each includes the next twice: 2^20 reads.
TEST(OthersFiles, FilesThatMultiplyAreRefusedAtOnce) {
  const std::string folder = ::testing::TempDir();
  for (int i = 0; i < 20; ++i) {
    const std::string next =
        i == 19 ? "" : "<include><uri>multiply" + std::to_string(i + 1) + ".sdf</uri></include>\n";
    std::ofstream(folder + "/multiply" + std::to_string(i) + ".sdf") << sdf_of(next + next);
  }
  const LoadError error = refusal_of(folder + "/multiply0.sdf");
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
  expect_urdf_refused(urdf_joint("j", hung("b", "b") + kLimit), "<joint name=\"j\"",
                      "hangs link 'b' on itself");
  expect_urdf_refused(
      urdf_joint("j", hung("a", "b") + kLimit) + urdf_joint("k", hung("b", "a") + kLimit),
      "<joint name=\"k\"", "hangs link 'a' on itself, by way of 'b'");
  expect_urdf_refused(
      urdf_joint("j", hung("a", "b") + kLimit + "\n<mimic joint=\"j\" multiplier=\"x\"/>"),
      "<mimic joint", "multiplier");
}

TEST(OthersFiles, UrdfJointOfAnUnknownTypeIsRefused) {
  expect_urdf_refused(urdf_joint("j", hung("a", "b") + kLimit, "hinge"), "<joint name=\"j\"",
                      "[hinge]");
}

struct Fault {
  const char* what;
  const char* from;   ///< in the text of the joint or the next link
  const char* until;  ///< end of the replaced text; "": of `from`
  const char* to;     ///< NAME is the joint's name
  const char* said;   ///< part of the message
  bool in_link = false;
};

std::string with_fault(std::string text, const Fault& fault, const std::string& joint, int& line) {
  auto at = text.find("<joint name=\"" + joint + "\"");
  EXPECT_NE(at, std::string::npos) << joint;
  if (fault.in_link) at = text.find("<link name=\"", at);
  at = text.find(fault.from, at);
  EXPECT_NE(at, std::string::npos) << fault.what;
  const std::string until = *fault.until ? fault.until : fault.from;
  std::string to = fault.to;
  if (const auto name = to.find("NAME"); name != std::string::npos) to.replace(name, 4, joint);
  line = 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
  return text.replace(at, text.find(until, at) + until.size() - at, to);
}

void expect_refused_near(const LoadError& error, const Fault& fault, const std::string& joint,
                         int line) {
  EXPECT_NE(error.message.find(fault.said), std::string::npos)
      << fault.what << " at " << joint << ": " << error.what();
  EXPECT_NEAR(error.line, line, 5) << fault.what << " at " << joint << ": " << error.what();
}

TEST(OthersFiles, TenOfEachFaultOfAnSdfAreRefusedWhereTheyStand) {
  const Fault faults[] = {
      {"no axis", "<axis>", "</axis>", "", "axis"},
      {"a limit twice", "<lower>", "", "<lower>0</lower><lower>", "given twice"},
      {"a type that is none", "\"revolute\"", "", "\"hinge\"", "hinge"},
      {"no such parent", "<parent>", "", "<parent>nobody_", "nobody_"},
      {"limits swapped", "<lower>", "</limit>", "<lower>1</lower><upper>-1</upper></limit>",
       "lower limit"},
      {"no limits", "<limit>", "</limit>", "", "limit"},
      {"a mass twice", "<mass>", "", "<mass>1</mass><mass>", "<mass> is given twice", true},
      {"ten thousand tons", "<mass>", "", "<mass>1000000", "<mass>", true},
      {"kilometres", "<size>", "", "<size>1000", "<size>", true},
      {"a word for a number", "<ixx>", "", "<ixx>about ", "about", true},
  };
  const std::string joints[] = {"l_hip_roll",    "l_hip_pitch", "l_knee",      "l_ankle_pitch",
                                "l_ankle_roll",  "r_hip_roll",  "r_hip_pitch", "r_knee",
                                "r_ankle_pitch", "head_pitch"};
  const std::string text = read_text(robot_file("generic21"));
  for (const Fault& fault : faults) {
    for (const std::string& joint : joints) {
      int line = 0;
      const TemporaryFile robot("robot.sdf", with_fault(text, fault, joint, line));
      expect_refused_near(refusal_of(robot.path()), fault, joint, line);
    }
  }
}

TEST(OthersFiles, TenOfEachFaultOfAUrdfAreRefusedWhereTheyStand) {
  const Fault faults[] = {
      {"no axis", "<axis", "/>", "<axis xyz=\"0 0 0\"/>", "axis"},
      {"no limit", "<limit", "/>", "", "limit"},
      {"no such parent", "<parent link=\"", "", "<parent link=\"nobody_", "nobody_"},
      {"a type that is none", "\"revolute\"", "", "\"hinge\"", "hinge"},
      {"a mimic", "<limit", "", "<mimic joint=\"neck\"/><limit", "mimics 'neck'"},
      {"a joint twice", "<joint name=", "",
       "<joint name=\"NAME\" type=\"fixed\"/>\n<joint name=", "given twice"},
      {"a second root", "<joint name=", "", "<link name=\"alone\"/>\n<joint name=", "root"},
      {"a comma", "xyz=\"0", "", "xyz=\"0,0", "finite"},
      {"ten thousand tons", "<mass value=\"", "", "<mass value=\"1000000", "<mass>", true},
  };
  const std::string joints[] = {"l_hip_roll",    "l_hip_pitch", "l_knee",      "l_ankle_pitch",
                                "l_ankle_roll",  "r_hip_roll",  "r_hip_pitch", "r_knee",
                                "r_ankle_pitch", "neck"};
  const std::string folder = VERP_SOURCE_DIR "/tests/host/model/odd_robot/";
  const std::string text = read_text(folder + "odd.urdf");
  const TemporaryFile robot("robot.sdf", read_text(folder + "robot.sdf"));
  const std::string urdf_path = std::filesystem::path(robot.path()).parent_path() / "odd.urdf";
  for (const Fault& fault : faults) {
    for (const std::string& joint : joints) {
      int line = 0;
      std::ofstream(urdf_path) << with_fault(text, fault, joint, line);
      expect_refused_near(refusal_of(robot.path()), fault, joint, line);
    }
  }
  std::filesystem::remove(urdf_path);
}

TEST(OthersFiles, APoseThatHangsOnItselfIsRefusedAtItsLink) {
  std::string text = read_text(robot_file("generic21"));
  const std::string pose = "<pose relative_to=\"r_hip_cross\">";
  const auto at = text.find(pose);
  ASSERT_NE(at, std::string::npos);
  const int line = line_of(text, pose);
  text.erase(at, text.find("</pose>", at) + 7 - at);
  const TemporaryFile robot("robot.sdf", text);
  const LoadError error = refusal_of(robot.path());
  EXPECT_NEAR(error.line, line, 5) << error.what();
}

// libsdformat looks into the working directory first, where the unprepared URDF is.
TEST(OthersFiles, OddRobotIsTheSameForWhoeverStandsInItsFolder) {
  const std::string folder = VERP_SOURCE_DIR "/tests/host/model/odd_robot";
  const auto before = std::filesystem::current_path();
  const std::size_t joints = load_robot(folder + "/robot.sdf").joints.size();
  std::filesystem::current_path(folder);
  EXPECT_EQ(load_robot("robot.sdf").joints.size(), joints);
  std::filesystem::current_path(before);
}

// The file gives no pose, gain or gait.
TEST(OthersFiles, OddRobotStandsOnWhatIsFoundForIt) {
  const Entity e = load_robot(VERP_SOURCE_DIR "/tests/host/model/odd_robot/robot.sdf");
  EXPECT_EQ(e.joints.size(), 15u) << "with the right hip's yaw, which has no servo";
  double mass_kg = 0;
  for (const Node& node : e.nodes) mass_kg += node.mass_kg;
  EXPECT_NEAR(mass_kg, 3.264, 1e-9) << "massless links have none, fingers have";
  for (const Joint& joint : e.joints) {
    if (!joint.name.ends_with("knee")) continue;
    EXPECT_GT(std::abs(joint.stand_rad), 1.0) << joint.name;
    EXPECT_GT(std::abs(joint.sit_rad), std::abs(joint.stand_rad)) << joint.name;
    EXPECT_GT(joint.servo.p_gain, 2000) << joint.name;
    EXPECT_EQ(joint.servo.profile_ms, 10) << joint.name;
  }
  EXPECT_FALSE(e.defaults.empty());
}

void expect_generic21_refused(const std::string& from, const std::string& to,
                              const std::string& said) {
  std::string text = read_text(robot_file("generic21"));
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  expect_sdf_refused(text, to, said);
}

TEST(OthersFiles, WhatTheLegsCannotDoIsRefused) {
  expect_generic21_refused("name=\"gait.hip_height_m\" value=\"0.",
                           "name=\"gait.hip_height_m\" value=\"0.9", "cannot stand level");
  expect_generic21_refused("name=\"left_leg\" base=\"trunk\" tip=\"l_sole\"/>",
                           "name=\"left_leg\" base=\"trunk\" tip=\"r_sole\"/>", "left_leg hangs");
  expect_generic21_refused("name=\"l_ankle_pitch\" rad=\"-0.", "name=\"l_ankle_pitch\" rad=\"0.",
                           "tilts the sole");
  std::string text = read_text(robot_file("generic21"));
  const std::string knee = "joint=\"r_knee\" id=\"13\" direction=\"-1\" type=\"";
  text.replace(text.find(knee) + knee.size(), std::string("xm430_w210").size(), "weak");
  text.insert(text.find("<verp:bus name=\"dxl\""),
              "<verp:servo_type name=\"weak\" like=\"xm430_w210\" stall_torque_n_m=\"0.4\" "
              "no_load_rev_min=\"77\" stall_current_a=\"1\" source=\"an XL330's\"/>");
  expect_sdf_refused(text, knee, "stands on one leg");
}

TEST(OthersFiles, RobotWithoutLegsOrImuIsRefused) {
  for (const std::string part : {"<verp:imu sensor=", "<verp:limb name=\"left_leg\""}) {
    std::string text = read_text(robot_file("generic21"));
    const auto at = text.find(part);
    ASSERT_NE(at, std::string::npos) << part;
    text.erase(at, text.find("/>", at) + 2 - at);
    const bool imu = part.starts_with("<verp:imu");
    expect_sdf_refused(text, imu ? "<model name" : "<verp:body", imu ? "no IMU" : "left_leg");
  }
}

std::string with_head_named(const std::string& name) {
  std::string text = read_text(robot_file("generic21"));
  for (auto at = text.find("\"head_yaw\""); at != std::string::npos; at = text.find("\"head_yaw\""))
    text.replace(at + 1, 8, name);
  return text;
}

TEST(OthersFiles, NamesAreOneLineEach) {
  expect_sdf_refused(with_head_named("head&#10;yaw"), "<joint name=\"head&#10;yaw", "the name '");
}

TEST(OthersFiles, LongNamesAreShortInTheControllerOnly) {
  const std::string name = "head_yaw_as_the_maker_calls_it";
  const TemporaryFile file("robot.sdf", with_head_named(name));
  const Entity robot = load_robot(file.path());
  const auto joint = std::find_if(robot.joints.begin(), robot.joints.end(),
                                  [&](const Joint& each) { return each.name == name; });
  ASSERT_NE(joint, robot.joints.end());
  const Params params = make_params(robot);
  const std::string inside = params.joint[joint - robot.joints.begin()].name;
  EXPECT_EQ(inside, short_name(name));
  EXPECT_EQ(inside.substr(0, 19), "head_yaw_as_the_ma_");
  EXPECT_NE(inside, short_name("head_yaw_as_the_maker_called_it"));
  EXPECT_NE(std::find(robot.notes.begin(), robot.notes.end(),
                      "'" + name + "' is '" + inside + "' to the controller"),
            robot.notes.end());
}

/// The odd robot with `with` in place of the first `part` of its URDF.
Entity odd_robot_with(const std::string& part, const std::string& with) {
  const std::string folder = VERP_SOURCE_DIR "/tests/host/model/odd_robot/";
  std::string text = read_text(folder + "odd.urdf"), wrapper = read_text(folder + "robot.sdf");
  const auto at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  const TemporaryFile urdf("odd.urdf", text.replace(at, part.size(), with));
  wrapper.replace(wrapper.find("odd.urdf"), 8,
                  std::filesystem::path(urdf.path()).filename().string());
  const TemporaryFile file("robot.sdf", wrapper);
  return load_robot(file.path());
}

// libsdformat would read the unprepared file, and lose links without mass.
TEST(OthersFiles, IncludeMayHaveAnyPath) {
  const std::string folder = VERP_SOURCE_DIR "/tests/host/model/odd_robot/";
  const std::string wrapper = read_text(folder + "robot.sdf");
  std::string climbing = folder + "odd.urdf";
  for (int i = 0; i < 12; ++i) climbing.insert(0, "/..");
  for (const std::string& uri : {folder + "odd.urdf", climbing.substr(1)}) {
    std::string text = wrapper;
    const TemporaryFile file("robot.sdf", text.replace(text.find("odd.urdf"), 8, uri));
    expect_same_robot(load_robot(file.path()), load_robot(folder + "robot.sdf"));
  }
}

TEST(OthersFiles, ShortNamesCutNoCharacterInTwo) {
  std::string name = "a";
  for (int i = 0; i < 12; ++i) name += "\xC3\xB6";
  EXPECT_EQ(short_name(name).substr(0, 18), name.substr(0, 17) + "_");
  EXPECT_EQ(short_name(name).size(), 22U);
}

TEST(OthersFiles, BallsAreOnlyForAUrdf) {
  std::string text = read_text(robot_file("generic21"));
  text.insert(text.find("</model>"),
              "<verp:inertia link=\"trunk\" ball_m=\"0.05\" reason=\"a guess\"/>\n");
  expect_sdf_refused(text, "<verp:inertia", "is in no URDF");
}

/// CAD exporters write zeros there.
TEST(OthersFiles, AxisOfAFixedJointIsNotLookedAt) {
  const std::string parent = "<parent link=\"base_link\"/>";
  EXPECT_EQ(odd_robot_with(parent, "<axis xyz=\"0 0 0\"/>" + parent).name, "odd");
}

TEST(OthersFiles, HabitsOfExportersThatChangeNothingLoad) {
  const Entity odd = odd_robot_with("<robot", "<robot");
  for (const auto& [part, with] :
       {std::pair{" effort=\"3\"", ""},
        {" velocity=\"7\"", ""},
        {"<robot name=\"odd\">", "<robot>"},
        {"xyz=\"0 0 0.09\"", "xyz=\"0\n\t0   0.09\""},
        {"</robot>",
         "<material name=\"a\"><color rgba=\"1 0 0 1\"/></material>"
         "<material name=\"a\"><color rgba=\"1 0 0 1\"/></material></robot>"}}) {
    const Entity robot = odd_robot_with(part, with);
    EXPECT_EQ(robot.joints.size(), odd.joints.size()) << with;
    EXPECT_EQ(total_mass(robot), total_mass(odd)) << with;
    EXPECT_EQ(robot.nodes[1].com_m, odd.nodes[1].com_m) << with;
  }
}

TEST(OthersFiles, RobotThatItsFileTiesToTheWorldIsFreeAndSaysSo) {
  for (const std::string type : {"floating", "planar"}) {
    const Entity robot = odd_robot_with("<joint name=\"base\" type=\"fixed\">",
                                        "<joint name=\"base\" type=\"" + type + "\">");
    ASSERT_FALSE(robot.notes.empty());
    EXPECT_EQ(robot.notes.back(), "joint 'base' ties the robot to 'base_link': left out");
    EXPECT_NEAR(total_mass(robot), total_mass(odd_robot_with("<robot", "<robot")), 1e-9);
  }
}

TEST(OthersFiles, OverlapsOfTheMakersShapesMayBeAllowedAtOnce) {
  std::string text = read_text(robot_file("generic21"));
  const auto at = text.find("</model>");
  text.insert(at, "<verp:box frame=\"l_foot\" centre=\"0 0 0.3\" size=\"0.1 0.1 0.1\"/>\n");
  expect_sdf_refused(text, "<link name=\"trunk\"", "overlap by");
  text.insert(at, "<verp:no_collide link=\"*\" other=\"*\" reason=\"the maker's\"/>\n");
  const TemporaryFile file("robot.sdf", text);
  const auto pairs = load_robot(file.path()).no_collide;
  EXPECT_TRUE(std::any_of(pairs.begin(), pairs.end(),
                          [](const NoCollide& pair) { return pair.reason == "the maker's"; }));
}

// The libraries expect a handful of links; 20,000 took minutes.
TEST(OthersFiles, TwentyThousandLinksAreRefusedAtOnce) {
  std::string links;
  for (int i = 0; i < 20000; ++i) links += sdf_link("a" + std::to_string(i));
  const TemporaryFile file("robot.sdf", sdf_of(links));
  const LoadError error = refusal_of(file.path());
  EXPECT_NE(error.message.find("more than 1000 <link>"), std::string::npos) << error.what();
}

}  // namespace
}  // namespace verp::model
