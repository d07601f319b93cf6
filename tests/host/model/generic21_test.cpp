#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "common/kinematics/forward.hpp"
#include "common/model/tree.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/robot/model/robot_table.hpp"
#include "tests/host/model/test_files.hpp"

namespace verp::model {
namespace {

const Entity& generic21() {
  static const Entity kEntity = load_robot(robot_file("generic21"));
  return kEntity;
}

int joint_index(const Entity& entity, const std::string& name) {
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    if (entity.joints[j].name == name) return static_cast<int>(j);
  }
  ADD_FAILURE() << "no joint " << name;
  return 0;
}

TEST(Generic21, HasTwentyOneJointsInFiveLimbs) {
  const Entity& e = generic21();
  EXPECT_EQ(e.joints.size(), 21u);
  const std::map<std::string, std::size_t> wanted = {
      {"head", 3}, {"left_arm", 3}, {"right_arm", 3}, {"left_leg", 6}, {"right_leg", 6}};
  ASSERT_EQ(e.limbs.size(), wanted.size());
  for (const Limb& limb : e.limbs) EXPECT_EQ(limb.joints.size(), wanted.at(limb.name)) << limb.name;
}

TEST(Generic21, IsKidSize) {
  double mass_kg = 0;
  for (const Node& node : generic21().nodes) mass_kg += node.mass_kg;
  EXPECT_NEAR(mass_kg, 3.262, 1e-9);
  EXPECT_GT(mass_kg, 3.0);
  EXPECT_LT(mass_kg, 4.0);
}

TEST(Generic21, LinksWeighAtLeastTheirServos) {
  // 21 servos of 82 g.
  RobotTable table(std::string(VERP_SOURCE_DIR) + "/common/robots/generic21/generic21.table");
  const auto pair = [&](const char* link) {
    return 2 * table.number(std::string(link) + "_servos");
  };
  double servos = table.number("trunk_servos") + table.number("neck_servos") +
                  table.number("head_cross_servos") + table.number("head_servos");
  for (const char* link : {"hip_yaw", "hip_roll", "thigh", "shank", "ankle", "foot", "shoulder",
                           "upper_arm", "forearm"}) {
    servos += pair(link);
  }
  EXPECT_EQ(servos, 21);
}

TEST(Generic21, LegsAreClosedForm) {
  for (const char* const name : {"left_leg", "right_leg"}) {
    const LegGeometry g = classify_leg(generic21(), *find_limb(generic21(), name));
    EXPECT_TRUE(g.closed_form) << g.reason;
    EXPECT_NEAR(g.thigh_m, 0.093, 1e-12);
    EXPECT_NEAR(g.shank_m, 0.093, 1e-12);
    EXPECT_NEAR(g.residual_m, 0, 1e-12);
    EXPECT_NEAR(std::abs(g.hip_m.y()), 0.037, 1e-12);
    EXPECT_NEAR(g.hip_m.z(), -0.085, 1e-12);
  }
}

TEST(Generic21, CarriesTheDatasheetsServos) {
  for (const Joint& joint : generic21().joints) {
    EXPECT_EQ(joint.servo.type, "xm430_w210");
    EXPECT_EQ(joint.servo.model_number, 1030);
    EXPECT_DOUBLE_EQ(joint.servo.stall_torque_n_m, 3.0);
    EXPECT_NEAR(joint.servo.no_load_speed_rad_s, 77 * 2 * std::numbers::pi / 60, 1e-12);
    EXPECT_NEAR(servo_stiffness_n_m_rad(joint.servo), 53.7, 0.1);
    EXPECT_LE(joint.velocity_limit_rad_s, joint.servo.no_load_speed_rad_s);
  }
}

TEST(Generic21, CarriesTheSensors) {
  const Entity& e = generic21();
  ASSERT_TRUE(e.imu.has_value());
  EXPECT_EQ(e.imu->node, 0);
  EXPECT_EQ(e.imu->id, 120);
  EXPECT_EQ(e.feet.id[0], 111);
  EXPECT_EQ(e.feet.id[1], 112);
  std::map<std::string, int> count;
  for (const OtherSensor& sensor : e.sensors) ++count[sensor.type + " on " + sensor.link];
  EXPECT_EQ(count["lidar on trunk"], 1);
  EXPECT_EQ(count["camera on skull"], 1);
  EXPECT_EQ(count["contact on l_foot"], 4);
  EXPECT_EQ(count["contact on r_foot"], 4);
}

TEST(Generic21, StandsAndSitsUprightOverItsFeet) {
  const Entity& e = generic21();
  for (const char* const p : {"l_", "r_"}) {
    for (const bool sit : {false, true}) {
      double sum = 0;
      for (const char* const name : {"hip_pitch", "knee", "ankle_pitch"}) {
        const Joint& joint =
            e.joints[static_cast<std::size_t>(joint_index(e, std::string(p) + name))];
        sum += sit ? joint.sit_rad : joint.stand_rad;
      }
      EXPECT_NEAR(sum, 0, 1e-4);
    }
  }
}

TEST(Generic21, LongerThighIsOneNumber) {
  std::string text =
      read_text(std::string(VERP_SOURCE_DIR) + "/common/robots/generic21/generic21.table");
  const std::string old_line = "thigh_m = 0.093";
  text.replace(text.find(old_line), old_line.size(), "thigh_m = 0.1023");
  const TemporaryFile table_file("longer.table", text);
  RobotTable table(table_file.path());
  const TemporaryFile sdf("longer.sdf", generate_humanoid_sdf(table));
  table.require_all_read();
  const Entity longer = load_robot(sdf.path());
  const LegGeometry g = classify_leg(longer, *find_limb(longer, "left_leg"));
  EXPECT_TRUE(g.closed_form);
  EXPECT_NEAR(g.thigh_m, 0.1023, 1e-9);
  const Params params = make_params(longer);
  EXPECT_NEAR(params.tuning.gait.hip_height_m, 0.79194 * (0.1023 + 0.093), 1e-6);
  // The hip is above the ankle at the gait's height.
  float angle_rad[kMaxJoints] = {};
  for (int j = 0; j < params.joint_count; ++j) angle_rad[j] = params.joint[j].stand_rad;
  const int ankle = find_joint(params, "l_ankle_pitch") + 1;
  const verp::Pose foot = kinematics::node_pose(params, verp::Pose{}, angle_rad, ankle);
  EXPECT_NEAR(params.leg[0].hip_body_m.z - foot.position_m.z(), params.tuning.gait.hip_height_m,
              1e-5);
  EXPECT_NEAR(params.leg[0].hip_body_m.x, foot.position_m.x(), 1e-5);
}

TEST(RobotTable, MisspeltKeyIsRefused) {
  std::string text =
      read_text(std::string(VERP_SOURCE_DIR) + "/common/robots/generic21/generic21.table");
  const TemporaryFile file("t.table", text + "thight_m = 0.1\n");
  RobotTable table(file.path());
  generate_humanoid_sdf(table);
  EXPECT_THROW(table.require_all_read(), LoadError);
  const TemporaryFile twice("twice.table", text + "thigh_m = 0.1\n");
  EXPECT_THROW(RobotTable{twice.path()}, LoadError);
}

/// The paper: x left, y up, z forward; (x, y, z)_paper = (y, z, x).
Vec3 paper(const Vec3& ours) {
  return {ours.y(), ours.z(), ours.x()};
}

TEST(PaperFrame, AxesAreACyclicPermutationOfOurs) {
  EXPECT_EQ(paper(Vec3::UnitX()), Vec3::UnitZ());  // forward
  EXPECT_EQ(paper(Vec3::UnitY()), Vec3::UnitX());  // left
  EXPECT_EQ(paper(Vec3::UnitZ()), Vec3::UnitY());  // up
  const Vec3 a(1, 2, 3), b(-2, 5, 7);
  EXPECT_EQ(paper(a.cross(b)), paper(a).cross(paper(b)));  // stays right-handed
}

TEST(PaperFrame, WorldOriginLiesOnTheGroundBetweenTheSoles) {
  const std::string sdf = read_text(robot_file("generic21"));
  // The sum of the legs' and the trunk's lengths.
  EXPECT_NE(sdf.find("<pose relative_to=\"__model__\">0 0 0.3045 0 0 0</pose>"), std::string::npos);
  const Params params = make_params(generic21());
  for (int foot = 0; foot < kFeet; ++foot) {
    const LegParams& leg = params.leg[foot];
    float zero[kLegJoints] = {};
    const verp::Pose sole =
        kinematics::sole_pose(leg, kinematics::leg_chain(params, leg, verp::Pose{}, zero));
    EXPECT_NEAR(sole.position_m.z() + 0.3045F, 0, 1e-6);
    EXPECT_NEAR(sole.position_m.x(), 0, 1e-6);
    EXPECT_NEAR(sole.position_m.y(), foot == 0 ? 0.037F : -0.037F, 1e-6);
  }
}

TEST(PaperFrame, BodyFrameIsTheTrunksCentreNotTheCentreOfMass) {
  const Entity& e = generic21();
  ASSERT_EQ(e.nodes[0].collisions.size(), 1u);
  EXPECT_NEAR(e.nodes[0].collisions[0].pose.translation().norm(), 0, 1e-12);
  EXPECT_GT(e.nodes[0].com_m.norm(), 0.002);
  const Params params = make_params(e);
  float zero[kMaxJoints] = {};
  EXPECT_LT(kinematics::center_of_mass(params, verp::Pose{}, zero).z(), -0.03F);
}

struct Sense {
  const char* joint;
  Vec3 point_m;  ///< link's frame
  Vec3 goes;     ///< our frame
  const char* words;
};

TEST(PaperFrame, PositiveSenseOfEachJoint) {
  const Vec3 ahead(0.1, 0, 0), above(0, 0, 0.1), below(0, 0, -0.1);
  const Vec3 left = Vec3::UnitY(), back = -Vec3::UnitX(), down = -Vec3::UnitZ();
  std::vector<Sense> senses = {{"head_yaw", ahead, left, "looks left"},
                               {"head_pitch", ahead, down, "looks down"},
                               {"head_roll", above, -left, "tilts to the right"}};
  std::vector<std::string> names;
  for (const std::string p : {"l_", "r_"}) {
    for (const char* n : {"shoulder_pitch", "elbow", "hip_pitch", "knee", "ankle_pitch"})
      names.push_back(p + n);
  }
  for (const std::string& name : names)
    senses.push_back({name.c_str(), below, back, "swings back"});
  for (const char* name : {"l_shoulder_roll", "r_shoulder_roll", "l_hip_roll", "r_hip_roll",
                           "l_ankle_roll", "r_ankle_roll"}) {
    senses.push_back({name, below, left, "swings to the left"});
  }
  for (const char* name : {"l_hip_yaw", "r_hip_yaw"})
    senses.push_back({name, ahead, left, "turns to the left"});
  EXPECT_EQ(senses.size(), 21u);
  const Params params = make_params(generic21());
  for (const Sense& sense : senses) {
    const int j = find_joint(params, sense.joint);
    ASSERT_GE(j, 0) << sense.joint;
    const verp::Pose moved = kinematics::joint_transform(params.joint[j], 0.01F);
    const Vec3 motion = moved.rotation.cast<double>() * sense.point_m - sense.point_m;
    EXPECT_GT(motion.dot(sense.goes) / motion.norm(), 0.99) << sense.joint << " " << sense.words;
  }
}

}  // namespace
}  // namespace verp::model
