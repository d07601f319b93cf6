#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "host/robot/model/unread.hpp"
#include "tests/host/model/bad_input.hpp"

/// The list names what a robot's file says and VERP does not read.
namespace verp::model {
namespace {

std::vector<std::string> told_of(const std::string& text) {
  const TemporaryFile file("robot.xml", text);
  const XmlSource source(file.path());
  Lost lost;
  for (const XmlElement& top : source.tops()) find_unread(top, lost);
  return lines_of(lost);
}

using Lines = std::vector<std::string>;

Lines told_of_link(const std::string& inside) {
  return told_of("<sdf version='1.9'><model name='m'><link name='a'>" + inside +
                 "</link></model></sdf>");
}

Lines told_of_joint(const std::string& inside) {
  return told_of("<robot name='r'><joint name='j' type='revolute'>" + inside + "</joint></robot>");
}

TEST(Unread, NotesOfALoadedRobotNameWhatTheTwinLacks) {
  const TemporaryFile file(
      "robot.sdf", edited("<link name=\"trunk\">",
                          "<model name='pack'><link name='b'><inertial><mass>0.5</mass></inertial>"
                          "</link></model><link name=\"trunk\"><kinematic>1</kinematic>"));
  const Entity robot = load_robot(file.path());
  for (const char* const line :
       {"<kinematic> of links (trunk)", "models in the model, with their links (pack)"}) {
    EXPECT_EQ(std::count(robot.notes.begin(), robot.notes.end(),
                         std::string("changed or left out: ") + line),
              1)
        << line;
  }
}

TEST(Unread, OurOwnRobotsLeaveNothingOut) {
  EXPECT_EQ(told_of(read_text(robot_file("generic21"))), Lines{});
  EXPECT_EQ(told_of(read_text(robot_file("op3"))), Lines{});
}

TEST(Unread, EachUnreadElementOfSdfIsNamed) {
  EXPECT_EQ(told_of_link("<velocity_decay><linear>0.9</linear></velocity_decay>"),
            Lines{"<velocity_decay> of links (a)"});
  EXPECT_EQ(told_of_link("<plugin name='p' filename='f'><x>0</x></plugin>"), Lines{"plugins (p)"});
  EXPECT_EQ(told_of_link("<visual name='v'><geometry><polyline/></geometry></visual>"),
            Lines{"shapes of type polyline (v)"});
  EXPECT_EQ(
      told_of("<sdf version='1.9'><model name='m'><static>1</static><joint name='j' "
              "type='revolute'><axis><dynamics><spring_stiffness>5</spring_stiffness>"
              "<spring_reference>1</spring_reference></dynamics></axis></joint></model></sdf>"),
      (Lines{"<static>: the robot moves (m)", "springs of joints (spring_stiffness) (j)"}));
}

TEST(Unread, ValuesThatChangeNothingAreNotTold) {
  EXPECT_EQ(told_of_link("<gravity>1</gravity><kinematic>0</kinematic><self_collide>false"
                         "</self_collide><velocity_decay><linear>0.0</linear></velocity_decay>"),
            Lines{});
}

TEST(Unread, LinkWithoutGravityIsRefused) {
  expect_refused(edited("<link name=\"trunk\">", "<link name=\"trunk\"><gravity>0</gravity>"),
                 "<gravity>", "gravity pulls at every link");
}

TEST(Unread, ZeroQuaternionAndZeroScaleAreRefused) {
  expect_refused(edited("<pose relative_to=\"trunk\">0 0 0.085 0 0 0</pose>",
                        "<pose relative_to=\"trunk\" rotation_format=\"quat_xyzw\">0 0 0.085 0 0 0 "
                        "0</pose>"),
                 "quat_xyzw", "its quaternion is zero");
  const std::string mesh = "<robot name='r'>\n<mesh filename='a.stl' scale='1 0 1'/></robot>";
  try {
    told_of(mesh);
    FAIL() << "was accepted";
  } catch (const LoadError& error) {
    EXPECT_EQ(error.line, 2);
    EXPECT_EQ(error.message, "<mesh> scale is zero: '1 0 1'");
  }
}

TEST(Unread, EachUnreadElementOfUrdfIsNamed) {
  EXPECT_EQ(
      told_of("<robot name='r'><transmission name='t'/><foo/><gazebo reference='a'>"
              "<gravity>0</gravity></gazebo></robot>"),
      (Lines{"<foo> (r)", "<gravity>0: gravity pulls at all links (a)", "<transmission> (t)"}));
  EXPECT_EQ(told_of("<robot name='r'><link name='a'><visual><geometry><octree/></geometry>"
                    "</visual></link></robot>"),
            Lines{"shapes of type octree (a)"});
  EXPECT_EQ(told_of_joint("<safety_controller k_velocity='1'/>"),
            Lines{"soft limits of joints (safety_controller): the controller has its own (j)"});
}

TEST(Unread, ValuesThatAreGuessedAreNamed) {
  EXPECT_EQ(told_of_joint("<limit lower='2' upper='-2' effort='-1' velocity='0'/>"),
            (Lines{"<limit> effort of zero or less: taken as not given (j)",
                   "<limit> velocity of zero or less: taken as not given (j)",
                   "swapped lower and upper limits: taken in order (j)"}));
  EXPECT_EQ(told_of_joint("<limit lower='-2' upper='2' effort='inf' velocity='7'/>"), Lines{});
  EXPECT_EQ(told_of_joint("<mimic joint='k'/>"),
            Lines{"<mimic> of joint 'k', which there is not: a servo turns it (j)"});
  EXPECT_EQ(told_of_joint("<mimic joint='j'/>"), Lines{});
  EXPECT_EQ(told_of("<robot name='r'><link name='a'><visual><geometry><mesh filename='a.stl' "
                    "scale='0.001'/></geometry></visual></link></robot>"),
            Lines{"<mesh> scale of one number: taken for all three axes (a.stl)"});
}

TEST(Unread, ManyNamesAreCut) {
  Lost lost;
  for (int i = 0; i < 20; ++i) lost["x"].push_back(std::to_string(i));
  EXPECT_EQ(lines_of(lost), Lines{"x (0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, and 8 more)"});
}

}  // namespace
}  // namespace verp::model
