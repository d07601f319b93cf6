#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "common/kinematics/forward.hpp"
#include "common/kinematics/leg_ik.hpp"
#include "common/model/leg.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/model/test_files.hpp"

/// The shipped robots whose legs have no ankle roll.
namespace verp::model {
namespace {

constexpr int kRoll = kLegJoints - 1;

struct Duck {
  const char* name;
  double mass_kg, thigh_m, shank_m;
  const char* servo;
  double tilt_rad;  ///< of the soles where it stands, at most
  BusProtocol protocol;
};

void PrintTo(const Duck& duck, std::ostream* out) {
  *out << duck.name;
}

class Ducks : public testing::TestWithParam<Duck> {};

INSTANTIATE_TEST_SUITE_P(Shipped, Ducks,
                         testing::Values(Duck{"microduck", 0.73724, 0.0429, 0.042, "xl330", 0.005,
                                              BusProtocol::kDynamixel2},
                                         Duck{"open_duck", 2.06155, 0.0791, 0.0786, "sts3215",
                                              0.072, BusProtocol::kFeetech}),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(Ducks, HaveTheirMakersNumbers) {
  const Entity e = load_robot(robot_file(GetParam().name));
  ASSERT_EQ(e.joints.size(), 14u);
  double mass_kg = 0;
  for (const Node& node : e.nodes) mass_kg += node.mass_kg;
  EXPECT_NEAR(mass_kg, GetParam().mass_kg, 1e-5);
  for (const Joint& joint : e.joints) EXPECT_EQ(joint.servo.type, GetParam().servo) << joint.name;
  EXPECT_EQ(make_params(e).bus_protocol, GetParam().protocol);
  for (const char* const side : {"left_leg", "right_leg"}) {
    const LegGeometry leg = classify_leg(e, *find_limb(e, side));
    EXPECT_NEAR(leg.thigh_m, GetParam().thigh_m, 1e-4);
    EXPECT_NEAR(leg.shank_m, GetParam().shank_m, 1e-4);
  }
}

verp::Pose pose_of(const Params& params, const LegParams& leg, const float* angle_rad) {
  return kinematics::sole_pose(leg, kinematics::leg_chain(params, leg, verp::Pose{}, angle_rad));
}

// open_duck's maker, too, has its feet closer together than where its soles are level.
TEST_P(Ducks, StandOnLevelSolesOrNearlySo) {
  const Params params = make_params(load_robot(robot_file(GetParam().name)));
  for (const LegParams& leg : params.leg) {
    EXPECT_FALSE(has(leg, kRoll));
    float stand_rad[kLegJoints];
    for (int k = 0; k < kLegJoints; ++k) stand_rad[k] = joint_of(params, leg, k).stand_rad;
    EXPECT_LT(std::acos(pose_of(params, leg, stand_rad).rotation(2, 2)), GetParam().tilt_rad);
  }
}

TEST_P(Ducks, LegsOfFiveJointsPutTheirSolesWhereTheyAreAskedTo) {
  const Params params = make_params(load_robot(robot_file(GetParam().name)));
  std::minstd_rand random(1);
  const auto within = [&](float half) {
    return half * (static_cast<float>(random() % 2001) / 1000 - 1);
  };
  for (int round = 0; round < 400; ++round) {
    const LegParams& leg = params.leg[round % 2];
    float leg_rad[kLegJoints] = {}, start_rad[kLegJoints] = {};
    for (int k = 0; k < kRoll; ++k) {
      const JointParams& joint = joint_of(params, leg, k);
      leg_rad[k] = std::clamp(joint.stand_rad + within(0.25F), joint.lower_rad + 0.02F,
                              joint.upper_rad - 0.02F);
      start_rad[k] = leg_rad[k] + within(0.02F);
    }
    const verp::Pose sole = pose_of(params, leg, leg_rad);
    const kinematics::LegAngles solved = kinematics::solve_leg(params, leg, sole, start_rad);
    EXPECT_EQ(int{solved.flags}, 0) << round;
    const verp::Pose found = pose_of(params, leg, solved.angle_rad);
    EXPECT_LT((found.position_m - sole.position_m).norm(), 1e-4F) << round;
    EXPECT_LT((found.rotation - sole.rotation).norm(), 2e-3F) << round;
  }
}

}  // namespace
}  // namespace verp::model
