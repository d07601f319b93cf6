#include "common/kinematics/leg_ik.hpp"
#include "common/model/image.hpp"
#include "common/model/leg.hpp"
#include "host/robot/model/check.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/model/test_files.hpp"

/// generic21 with joints of its legs fixed, as a user does it.
namespace verp::model {
namespace {

std::string generic21_without(const std::vector<std::string>& joints) {
  std::string text = read_text(robot_file("generic21"));
  std::string fixed = "<verp:body link=\"trunk\"/>";
  for (const std::string& joint : joints) {
    for (const std::string side : {"l_", "r_"}) {
      const std::string servo = "<verp:servo joint=\"" + side + joint + "\"";
      while (text.find(servo) != std::string::npos) text = without_element(text, servo);
      fixed += "<verp:fix joint=\"" + side + joint + "\" reason=\"test\"/>";
    }
  }
  const std::string body = "<verp:body link=\"trunk\"/>";
  return text.replace(text.find(body), body.size(), fixed);
}

Entity loaded_without(const std::vector<std::string>& joints) {
  const TemporaryFile file("robot.sdf", generic21_without(joints));
  return load_robot(file.path());
}

bool says(const Entity& robot, const std::string& words) {
  return describe(robot).find(words) != std::string::npos;
}

TEST(FewJoints, LegsWithoutAnkleRollStandOnLevelSoles) {
  const Entity robot = loaded_without({"ankle_roll"});
  const Params params = make_params(robot);
  EXPECT_TRUE(is_well_formed(params));
  EXPECT_TRUE(says(robot, "legs of five joints: no ankle roll, so each sole rolls with its leg"));
  for (const LegParams& leg : params.leg) {
    EXPECT_FALSE(has(leg, 5));
    EXPECT_EQ(leg.solver, LegSolver::kNewton);
    float angle_rad[kLegJoints];
    for (int k = 0; k < kLegJoints; ++k) angle_rad[k] = joint_of(params, leg, k).stand_rad;
    const verp::Pose sole =
        kinematics::sole_pose(leg, kinematics::leg_chain(params, leg, verp::Pose{}, angle_rad));
    EXPECT_GT(sole.rotation(2, 2), 0.9999F);
  }
}

TEST(FewJoints, LegsWithoutHipYawDoNotTurn) {
  const Entity robot = loaded_without({"hip_yaw"});
  const Params params = make_params(robot);
  EXPECT_TRUE(says(robot, "legs of five joints: no hip yaw, so it walks straight"));
  EXPECT_TRUE(says(robot, "not in the file: gait.max_turn_rad 0, from its legs without hip yaw"));
  EXPECT_EQ(params.tuning.gait.max_turn_rad, 0.0F);
  for (const LegParams& leg : params.leg) {
    EXPECT_FALSE(has(leg, 0));
    EXPECT_EQ(params.joint[leg.joint[3]].name[2], 'k');
  }
}

TEST(FewJoints, LegsOfFourLackBoth) {
  const Entity robot = loaded_without({"hip_yaw", "ankle_roll"});
  EXPECT_TRUE(says(robot, "legs of four joints: no hip yaw"));
  EXPECT_TRUE(says(robot, "legs of four joints: no ankle roll"));
  EXPECT_TRUE(is_well_formed(make_params(robot)));
}

TEST(FewJoints, ALegThatLacksAnotherJointIsRefusedAndSaidWhich) {
  for (const std::vector<std::string>& joints :
       {std::vector<std::string>{"hip_roll"}, {"hip_roll", "hip_yaw"}}) {
    const TemporaryFile file("robot.sdf", generic21_without(joints));
    const LoadError error = refusal_of(file.path());
    EXPECT_NE(error.message.find("a leg needs hip yaw, roll and pitch"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace verp::model
