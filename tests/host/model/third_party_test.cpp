#include <gtest/gtest.h>

#include <cmath>

#include "common/kinematics/forward.hpp"
#include "common/kinematics/leg_ik.hpp"
#include "common/model/tree.hpp"
#include "host/robot/model/export.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/model/test_files.hpp"

namespace verp::model {
namespace {

double mass_of(const Entity& entity) {
  double sum = 0;
  for (const Node& node : entity.nodes) sum += node.mass_kg;
  return sum;
}

/// A level sole at walking height is reached without flags.
void expect_walkable(const Entity& entity) {
  const Params params = make_params(entity);
  for (int foot = 0; foot < kFeet; ++foot) {
    const LegParams& leg = params.leg[foot];
    verp::Pose sole;
    sole.position_m << leg.hip_body_m.x,
        foot == 0 ? params.tuning.gait.half_stance_m : -params.tuning.gait.half_stance_m,
        leg.hip_body_m.z - params.tuning.gait.hip_height_m + leg.sole_foot_m.z;
    float stand_rad[kLegJoints];
    for (int k = 0; k < kLegJoints; ++k) stand_rad[k] = params.joint[leg.joint[k]].stand_rad;
    const kinematics::LegAngles solved = kinematics::solve_leg(params, leg, sole, stand_rad);
    EXPECT_EQ(solved.flags, 0) << entity.name << " foot " << foot;
    const verp::Pose found = kinematics::sole_pose(
        leg, kinematics::leg_chain(params, leg, verp::Pose{}, solved.angle_rad));
    EXPECT_LT((found.position_m - sole.position_m).norm(), 2e-4F);
    EXPECT_LT((found.rotation - sole.rotation).norm(), 1e-3F);
    // The stand pose is that posture, but for the stance width.
    for (int k = 0; k < kLegJoints; ++k) EXPECT_NEAR(solved.angle_rad[k], stand_rad[k], 0.02F) << k;
  }
}

TEST(Op3, LoadsWithItsKnownNumbers) {
  const Entity e = load_robot(robot_file("op3"));
  EXPECT_EQ(e.joints.size(), 20u);
  EXPECT_NEAR(mass_of(e), 3.14753, 1e-4);
  const LegGeometry g = classify_leg(e, *find_limb(e, "left_leg"));
  EXPECT_TRUE(g.closed_form) << g.reason;
  EXPECT_NEAR(g.thigh_m, 0.11015, 1e-4);
  EXPECT_NEAR(g.shank_m, 0.110, 1e-4);
  EXPECT_LT(g.residual_m, 1e-4);
  for (const Joint& joint : e.joints) EXPECT_LT(joint.velocity_limit_rad_s, 5.0) << joint.name;
  expect_walkable(e);
}

TEST(DarwinOp, LoadsWithItsKnownNumbers) {
  const Entity e = load_robot(robot_file("darwin_op"));
  EXPECT_EQ(e.joints.size(), 20u);
  EXPECT_NEAR(mass_of(e), 3.21906, 1e-4);
  const LegGeometry g = classify_leg(e, *find_limb(e, "right_leg"));
  EXPECT_TRUE(g.closed_form) << g.reason;
  EXPECT_NEAR(g.thigh_m, 0.093, 1e-4);
  EXPECT_NEAR(g.shank_m, 0.093, 1e-4);
  expect_walkable(e);
}

TEST(ThirdParty, ImagesAreSound) {
  for (const char* const name : {"op3", "darwin_op"}) {
    const ParamsImage image = make_image(load_robot(robot_file(name)));
    EXPECT_EQ(check_image(&image, sizeof image), ImageFault::kNone) << name;
  }
}

/// Around a URDF of two links; `extra` is in the joint, `more` beside it.
class SmallUrdf {
 public:
  SmallUrdf(const std::string& extra, const std::string& more)
      : urdf_("small.urdf",
              "<robot name=\"small\">\n" + link("a") + link("b") +
                  "<joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/>\n"
                  "<axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" "
                  "velocity=\"1\"/>" +
                  extra + "</joint>\n" + more + "</robot>\n") {}
  std::string wrapper(const std::string& facts) const {
    const std::string name = std::filesystem::path(urdf_.path()).filename().string();
    return "<sdf version=\"1.9\" xmlns:verp=\"https://verp.dev/sdf/1\"><model name=\"small\">"
           "<include merge=\"true\"><uri>" +
           name + "</uri></include><verp:body link=\"a\"/><verp:bus protocol=\"dynamixel2\">" +
           "<verp:servo joint=\"j\" id=\"1\" type=\"mx28\"/></verp:bus>" + facts + "</model></sdf>";
  }
  static std::string link(const std::string& name) {
    return "<link name=\"" + name +
           "\"><inertial><mass value=\"1\"/><inertia ixx=\"0.001\" iyy=\"0.001\" izz=\"0.001\" "
           "ixy=\"0\" ixz=\"0\" "
           "iyz=\"0\"/></inertial></link>\n";
  }

 private:
  TemporaryFile urdf_;
};

TEST(Urdf, IsLoadedThroughAWrapperBesideIt) {
  const SmallUrdf urdf("<origin xyz=\"0 0 1\"/>", "");
  const TemporaryFile file("robot.sdf", urdf.wrapper(""));
  const Entity e = load_part_of_robot(file.path());
  ASSERT_EQ(e.joints.size(), 1u);
  EXPECT_NEAR(e.joints[0].origin_m.z(), 1, 1e-12);
}

TEST(Urdf, ShapeWithoutMassIsRefusedUnlessDeclared) {
  const std::string other =
      "<link name=\"c\"><visual><geometry><sphere radius=\"0.1\"/></geometry></visual></link>\n"
      "<joint name=\"k\" type=\"fixed\"><parent link=\"b\"/><child "
      "link=\"c\"/></joint>\n";
  const SmallUrdf urdf("<origin xyz=\"0 0 1\"/>", other);
  {
    const TemporaryFile file("robot.sdf", urdf.wrapper(""));
    try {
      load_robot(file.path());
      FAIL();
    } catch (const LoadError& error) {
      EXPECT_NE(error.message.find("link 'c' has a shape and no mass"), std::string::npos)
          << error.what();
    }
  }
  const TemporaryFile file(
      "robot.sdf",
      urdf.wrapper("<verp:drop what=\"massless_link\" name=\"c\" reason=\"a frame\"/>"));
  EXPECT_EQ(load_part_of_robot(file.path()).joints.size(), 1u);
}

// Other programs need such chains; all keep their names.
TEST(Urdf, ChainOfMasslessLinksCarriesWhatHangsOnIt) {
  const auto fixed = [](const std::string& name, const std::string& parent,
                        const std::string& child) {
    return "<joint name=\"" + name + "\" type=\"fixed\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/><origin xyz=\"0 0 0.1\"/></joint>\n";
  };
  const std::string more = "<link name=\"c\"/><link name=\"d\"/>" + SmallUrdf::link("e") +
                           fixed("k", "b", "c") + fixed("l", "c", "d") + fixed("m", "d", "e");
  const SmallUrdf urdf("<origin xyz=\"0 0 1\"/>", more);
  const TemporaryFile file("robot.sdf",
                           urdf.wrapper("<verp:limb name=\"head\" base=\"a\" tip=\"d\"/>"));
  const Entity e = load_part_of_robot(file.path());
  ASSERT_EQ(e.joints.size(), 1u);
  EXPECT_NEAR(mass_of(e), 3, 1e-12);
  EXPECT_NEAR(e.nodes[1].com_m.z(), 0.15, 1e-9);
  EXPECT_NEAR(e.limbs.at(0).tip.translation().z(), 0.2, 1e-9);
}

TEST(Urdf, LinkAndJointMayHaveOneName) {
  const std::string more =
      SmallUrdf::link("k") +
      "<joint name=\"k\" type=\"revolute\"><parent link=\"b\"/><child link=\"k\"/><origin "
      "xyz=\"0 0 1\"/><axis xyz=\"0 0 1\"/>"
      "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>\n";
  const SmallUrdf urdf("<origin xyz=\"0 0 1\"/>", more);
  std::string text = urdf.wrapper("");
  text.insert(text.find("<verp:servo"), "<verp:servo joint=\"k\" id=\"2\" type=\"mx28\"/>");
  const TemporaryFile file("robot.sdf", text);
  const Entity e = load_part_of_robot(file.path());
  ASSERT_EQ(e.joints.size(), 2u);
  EXPECT_EQ(e.joints[1].name, "k");
  EXPECT_EQ(e.nodes[2].name, "k");
}

// Fingers: one slides, one bends, one mimics.
TEST(Urdf, FixedJointsAreNoJointsAndStandWhereTheyWereFixed) {
  const auto joint = [](const std::string& name, const std::string& type, const std::string& more) {
    return SmallUrdf::link(name + "_tip") + "<joint name=\"" + name + "\" type=\"" + type +
           "\"><parent link=\"b\"/><child link=\"" + name +
           "_tip\"/><origin xyz=\"0 0 1\"/><axis xyz=\"1 0 0\"/>"
           "<limit lower=\"-2\" upper=\"2\" effort=\"1\" velocity=\"1\"/>" +
           more + "</joint>\n";
  };
  const std::string carried =
      SmallUrdf::link("nail") +
      "<joint name=\"n\" type=\"fixed\"><parent link=\"bent_tip\"/><child link=\"nail\"/><origin "
      "xyz=\"0 0 1\"/></joint>\n";
  const SmallUrdf urdf("<origin xyz=\"0 0 1\"/>",
                       joint("slide", "prismatic", "") + joint("bent", "revolute", "") +
                           joint("mimic", "revolute", "<mimic joint=\"bent\"/>") + carried);
  const std::string fixes =
      "<verp:fix joint=\"slide\" reason=\"a finger\"/><verp:fix joint=\"mimic\" "
      "reason=\"a finger\"/><verp:fix joint=\"bent\" rad=\"1.5707963\" reason=\"a finger\"/>";
  const TemporaryFile file("robot.sdf", urdf.wrapper(fixes));
  const Entity e = load_part_of_robot(file.path());
  ASSERT_EQ(e.joints.size(), 1u);
  EXPECT_NEAR(mass_of(e), 6, 1e-12);
  // A right angle about x: the mass is now on the right.
  EXPECT_NEAR(e.nodes[1].com_m.y(), -1.0 / 5, 1e-6);
  const TemporaryFile wrong("wrong.sdf",
                            urdf.wrapper(fixes + "<verp:fix joint=\"thumb\" reason=\"?\"/>"));
  EXPECT_THROW(load_part_of_robot(wrong.path()), LoadError);
}

TEST(Urdf, DecimalCommaIsRefused) {
  const SmallUrdf urdf("<origin xyz=\"0 0,5 1\"/>", "");
  const TemporaryFile file("robot.sdf", urdf.wrapper(""));
  EXPECT_THROW(load_robot(file.path()), LoadError);
}

/// As other file conventions place the joints.
TEST(LegSolver, AxesApartBeyondHalfAMillimetreTakeNewton) {
  Entity e = load_robot(robot_file("generic21"));
  const Limb leg = *find_limb(e, "left_leg");
  e.joints[static_cast<std::size_t>(leg.joints[2])].origin_m.x() += 0.002;
  const LegGeometry g = classify_leg(e, leg);
  EXPECT_FALSE(g.closed_form);
  EXPECT_NE(g.reason.find("do not meet"), std::string::npos);
  EXPECT_EQ(make_params(e).leg[0].solver, LegSolver::kNewton);
}

TEST(LegSolver, SkewedHipAxisTakesNewton) {
  Entity e = load_robot(robot_file("generic21"));
  const Limb leg = *find_limb(e, "left_leg");
  Joint& yaw = e.joints[static_cast<std::size_t>(leg.joints[0])];
  yaw.axis = Vec3(0, 1, 1).normalized();
  const LegGeometry g = classify_leg(e, leg);
  EXPECT_FALSE(g.closed_form);
  EXPECT_NE(g.reason.find(yaw.name), std::string::npos);
}

TEST(LegSolver, BentZeroPoseBecomesOffsets) {
  Entity e = load_robot(robot_file("generic21"));
  const Limb leg = *find_limb(e, "left_leg");
  // In the zero pose the knee is 40 mm ahead.
  e.joints[static_cast<std::size_t>(leg.joints[3])].origin_m.x() += 0.04;
  e.joints[static_cast<std::size_t>(leg.joints[4])].origin_m.x() -= 0.04;
  const LegGeometry g = classify_leg(e, leg);
  ASSERT_TRUE(g.closed_form) << g.reason;
  EXPECT_NEAR(g.offset_rad[2], -std::atan2(0.04, 0.093), 1e-9);
  EXPECT_NEAR(g.offset_rad[3], 2 * std::atan2(0.04, 0.093), 1e-9);
  EXPECT_NEAR(g.offset_rad[4], -std::atan2(0.04, 0.093), 1e-9);
  const Params params = make_params(e);
  float zero[kLegJoints] = {};
  const verp::Pose sole = kinematics::sole_pose(
      params.leg[0], kinematics::leg_chain(params, params.leg[0], verp::Pose{}, zero));
  const kinematics::LegAngles solved = kinematics::solve_leg(params, params.leg[0], sole, zero);
  for (const float angle : solved.angle_rad) EXPECT_NEAR(angle, 0, 1e-4F);
}

}  // namespace
}  // namespace verp::model
