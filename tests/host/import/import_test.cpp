#include "host/author/import/import.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/model/image.hpp"
#include "host/os/files/temporary_directory.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/session/session.hpp"
#include "host/run/session/stride.hpp"
#include "tests/host/import/made_robot.hpp"

namespace verp::import {
namespace {

namespace fs = std::filesystem;

class ImportedFile : public ::testing::Test {
 protected:
  Imported import(const Habits& habits, const std::string& file = "robot.urdf") {
    urdf_ = folder_.path() / file;
    std::ofstream(urdf_) << Maker(habits).urdf();
    fs::create_directories(folder_.path() / "out");
    return import_robot({urdf_.string(), (folder_.path() / "out").string(), "", ""});
  }

  /// As import loaded it.
  static model::Entity loaded(const Imported& robot) {
    EXPECT_EQ(robot.refusal, "");
    return robot.entity ? *robot.entity : model::Entity();
  }

  /// As a user would load it.
  model::Entity loaded_from_file(const Imported& robot) {
    const fs::path sdf = folder_.path() / "out" / "robot.sdf";
    std::ofstream(sdf) << robot.sdf;
    return model::load_robot(sdf.string());
  }

  static const Finding& finding(const Imported& robot, const std::string& what) {
    static const Finding kNone;
    for (const Finding& each : robot.findings) {
      if (each.what == what) return each;
    }
    ADD_FAILURE() << what;
    return kNone;
  }

  static bool was_changed(const Imported& robot, const std::string& part) {
    return std::any_of(robot.left_out.begin(), robot.left_out.end(), [&](const std::string& each) {
      return each.find(part) != std::string::npos;
    });
  }

  /// Left is left, soles lie under the ankles, knees bend ahead of the hips.
  static void expect_a_biped(const model::Entity& robot) {
    const auto origins = model::node_origins(robot);
    for (const auto& [name, side] : {std::pair{"left_leg", 1.0}, {"right_leg", -1.0}}) {
      const model::Limb& leg = *model::find_limb(robot, name);
      const auto foot = static_cast<std::size_t>(leg.joints.back() + 1);
      EXPECT_NEAR(origins[foot].y(), 0.037 * side, 1e-6) << name;
      const auto knee = static_cast<std::size_t>(leg.joints[3]);
      EXPECT_GT(robot.joints[knee].stand_rad * robot.joints[knee].axis.y(), 0.2) << name;
    }
  }

  files::TemporaryDirectory folder_;
  fs::path urdf_;
};

TEST_F(ImportedFile, LegsAreFoundWhateverTheirNames) {
  const Imported robot = import({});
  EXPECT_EQ(finding(robot, "left_leg").value, "jp4_0, jp4_1, jp4_2, jp4_3, jp4_4, jp4_5");
  EXPECT_EQ(finding(robot, "right_arm").value, "jp3");
  EXPECT_EQ(robot.name, "part_studio_1");
  expect_a_biped(loaded(robot));
}

TEST_F(ImportedFile, ForeignFileStaysAsItIs) {
  const Imported robot = import({}, "a & b's <robot> 1.urdf");
  expect_a_biped(loaded_from_file(robot));
  EXPECT_EQ(files::read(urdf_), Maker({}).urdf());
}

TEST_F(ImportedFile, WhatNobodyReadsAndWhatIsMissingIsOnThePage) {
  const Imported robot = import({.feet_are_meshes = true,
                                 .more = "<transmission name=\"t\"/><gazebo reference=\"p1\">"
                                         "<gravity>0</gravity></gazebo>"});
  EXPECT_TRUE(was_changed(robot, "<transmission> (t)"));
  EXPECT_TRUE(was_changed(robot, "<gravity>0: gravity pulls at all links (p1)"));
  EXPECT_TRUE(was_changed(robot, "meshes that are not there (model://nowhere/"));
}

TEST_F(ImportedFile, SwappedLimitsAreTakenInOrder) {
  const Imported robot = import({.knee_lower_rad = 2.4, .knee_upper_rad = 0});
  EXPECT_TRUE(was_changed(robot, "swapped lower and upper limits"));
  EXPECT_FALSE(was_changed(robot, "no limits"));
  for (const model::Joint& joint : loaded(robot).joints) {
    if (joint.name == "jp4_3") {
      EXPECT_NEAR(joint.upper_rad, 2.4, 0.01);
    }
  }
}

TEST_F(ImportedFile, RobotMayLookAnyWayInItsFile) {
  for (const double yaw_rad : {1.5707963, 3.1415927, 0.5}) {
    const Imported robot = import({.yaw_rad = yaw_rad});
    expect_a_biped(loaded(robot));
    EXPECT_EQ(finding(robot, "ahead").sureness, Finding::Sureness::kMeasured);
  }
}

TEST_F(ImportedFile, JointsThatCarryBothArmsAreAWaistAndNothingIsFixed) {
  const Imported robot = import({.has_waist = true});
  EXPECT_EQ(finding(robot, "waist").value, "jp6");
  EXPECT_EQ(finding(robot, "left_arm").value, "jp2, jp2e");
  EXPECT_EQ(finding(robot, "right_arm").value, "jp3, jp3e");
  const model::Entity entity = loaded(robot);
  EXPECT_EQ(entity.joints.size(), 17U);
  EXPECT_LT(entity.joints.back().stand_rad, -0.1) << "elbows stand within their limits";
}

TEST_F(ImportedFile, NeckThatCarriesEarsIsNoWaist) {
  const Imported robot = import({.has_ears = true});
  EXPECT_TRUE(finding(robot, "head").value.starts_with("jp7, jp8, "));
  EXPECT_EQ(finding(robot, "left_arm").value, "jp2");
}

TEST_F(ImportedFile, FeetTellWhatIsAheadWhereKneesDoNot) {
  const Imported robot =
      import({.yaw_rad = 3.1415927, .knee_lower_rad = -2.4, .sole_ahead_m = 0.02});
  EXPECT_EQ(finding(robot, "ahead").value, "(-1, 0, 0) of the file: its feet are longer there");
  expect_a_biped(loaded(robot));
}

TEST_F(ImportedFile, WhereNothingTellsXIsAheadAndThisIsAGuess) {
  const Imported robot = import({.knee_lower_rad = -2.4, .sole_ahead_m = 0});
  EXPECT_EQ(finding(robot, "ahead").sureness, Finding::Sureness::kGuessed);
  expect_a_biped(loaded(robot));
}

TEST_F(ImportedFile, SolesAreTheLowestFacesOfTheFeet) {
  for (const bool wide : {false, true}) {
    const model::Entity robot = loaded(import({.has_wide_ankles = wide}));
    const model::Limb& leg = *model::find_limb(robot, "left_leg");
    EXPECT_NEAR(leg.sole_max_m.x() - leg.sole_min_m.x(), 0.1, 1e-4);
    EXPECT_NEAR(leg.sole_max_m.y() - leg.sole_min_m.y(), 0.06, 1e-4);
    EXPECT_NEAR(leg.tip.translation().x(), 0.01, 1e-6);
    EXPECT_NEAR(leg.tip.translation().z(), -0.03, 1e-6);
  }
}

TEST_F(ImportedFile, SolesThatAreNotLevelInTheFileAreStoodOnLevel) {
  for (const double pitch_rad : {0.25, -0.35}) {
    const Imported robot = import({.sole_pitch_rad = pitch_rad});
    EXPECT_EQ(finding(robot, "left sole").value,
              fmt::format("100 by 60 mm under p4_5, tilted by {} degrees where all joints are at "
                          "zero",
                          pitch_rad > 0 ? "14.3" : "20.1"));
    const model::Entity entity = loaded(robot);
    const model::Limb& leg = *model::find_limb(entity, "left_leg");
    EXPECT_NEAR(std::asin(leg.tip.linear()(0, 2)), pitch_rad, 0.003);
  }
}

TEST_F(ImportedFile, NarrowSolesAreSolesAndNoWiderOnesAreInvented) {
  const Imported robot = import({.sole_width_m = 0.01});
  EXPECT_EQ(finding(robot, "left sole").value, "100 by 10 mm under p4_5");
  EXPECT_EQ(finding(robot, "left sole").sureness, Finding::Sureness::kMeasured);
}

TEST_F(ImportedFile, RodsThatAreOnlyDrawnAreNoLegs) {
  const Imported robot = import({.has_rods = true});
  EXPECT_EQ(finding(robot, "left_leg").value, "jp4_0, jp4_1, jp4_2, jp4_3, jp4_4, jp4_5");
  expect_a_biped(loaded(robot));
}

TEST_F(ImportedFile, RobotStandsOnItsSolesAndOnNothingBelowThem) {
  const Imported robot = import({.has_low_shanks = true});
  EXPECT_TRUE(was_changed(robot, "collisions of p4_3, p5_3, which reach below the soles"));
  const model::Entity entity = loaded(robot);
  for (const model::Node& node : entity.nodes) {
    const bool shank = node.name == "p4_3" || node.name == "p5_3";
    EXPECT_FALSE(shank && !node.collisions.empty()) << node.name;
  }
}

TEST_F(ImportedFile, FeetWhoseMeshesAreMissingAreGuessedAndSaid) {
  const Imported robot = import({.feet_are_meshes = true});
  EXPECT_EQ(finding(robot, "left sole").sureness, Finding::Sureness::kGuessed);
  EXPECT_NE(page_of(robot, {"robot.urdf", "", "", ""}).find("**guessed**"), std::string::npos);
  expect_a_biped(loaded(robot));
}

TEST_F(ImportedFile, JointsWithoutStopsGetAServosTurn) {
  const Imported robot = import({.sole_ahead_m = 0.02, .has_no_stops = true});
  EXPECT_TRUE(was_changed(robot, "no limits, so a servo's single turn is taken: joints "));
  EXPECT_TRUE(was_changed(robot, ", jp4_3"));
  for (const model::Joint& joint : loaded(robot).joints)
    EXPECT_NEAR(joint.upper_rad - joint.lower_rad, 6.28, 0.01) << joint.name;
}

TEST_F(ImportedFile, StandsSoLowThatItsKneesCanStillLiftTheFeet) {
  const model::Entity robot = loaded(import({.knee_upper_rad = 0.9}));
  for (const model::Joint& joint : robot.joints) EXPECT_LE(joint.stand_rad, joint.upper_rad);
  EXPECT_TRUE(std::any_of(robot.defaults.begin(), robot.defaults.end(), [](const auto& each) {
    return each.find("the nearest within the legs' limits") != std::string::npos;
  }));
  const GaitTuning gait = model::make_params(robot).tuning.gait;
  EXPECT_NEAR(gait.hip_height_m - gait.lift_m, 0.186 * std::cos(0.45), 0.002);
}

TEST_F(ImportedFile, EmptyReferenceOfGazeboDoesNoHarm) {
  EXPECT_EQ(
      import({.more = "<gazebo reference=\"\"><sensor name=\"s\" type=\"imu\"/></gazebo>"}).refusal,
      "");
}

TEST_F(ImportedFile, ToesAreFixedAndSaid) {
  const Imported robot = import({.leg_joints = 7});
  EXPECT_TRUE(was_changed(robot, "jp4_6"));
  EXPECT_EQ(model::find_limb(loaded(robot), "left_leg")->joints.size(), 6U);
}

TEST_F(ImportedFile, MeshesOfNoPackageLieBesideTheFile) {
  std::ofstream(folder_.path() / "foot.stl")
      << "solid foot\nfacet normal 0 0 -1\nouter loop\nvertex -0.04 -0.03 -0.01\n"
         "vertex 0.06 -0.03 -0.01\nvertex 0.06 0.03 -0.01\nendloop\nendfacet\nendsolid foot\n";
  for (const bool drawn : {true, false}) {
    const Imported robot =
        import({.feet_are_meshes = true, .feet_are_drawn = drawn, .meshes = "package://"});
    EXPECT_EQ(finding(robot, "left sole").value, "100 by 60 mm under p4_5")
        << "a mesh that only touches is measured too";
  }
}

TEST_F(ImportedFile, LegsWithoutHipYawOrAnkleRollAreTakenAndSaid) {
  const std::tuple<Habits, std::size_t, std::string> all[] = {
      {{.leg_joints = 5}, 5, "no ankle roll"},
      {{.yaw_rad = 1.5708, .leg_joints = 5}, 5, "no ankle roll"},
      {{.has_hip_yaw = false}, 5, "no hip yaw"},
      {{.leg_joints = 5, .has_hip_yaw = false}, 4, "no hip yaw and no ankle roll"}};
  for (const auto& [habits, joints, lacks] : all) {
    const Imported robot = import(habits);
    EXPECT_EQ(finding(robot, "legs").value, "of fewer than six joints: " + lacks);
    EXPECT_EQ(finding(robot, "left sole").sureness, Finding::Sureness::kMeasured);
    const model::Entity entity = loaded(robot);
    const Params params = model::make_params(entity);
    EXPECT_TRUE(is_well_formed(params));
    for (const char* leg : {"left_leg", "right_leg"})
      EXPECT_EQ(model::find_limb(entity, leg)->joints.size(), joints) << lacks;
    EXPECT_NEAR(params.leg[0].thigh_m, 0.093F, 1e-4F) << lacks;
    EXPECT_NEAR(params.leg[0].shank_m, 0.093F, 1e-4F) << lacks;
  }
}

TEST_F(ImportedFile, MomentsInAnotherUnitBecomeThoseOfTheSameRobot) {
  const model::Entity robot = loaded(import({}));
  for (const double times : {1e3, 1e6}) {
    const Imported other = import({.moments_times = times});
    EXPECT_TRUE(was_changed(other, "all moments of inertia are taken as "));
    const double share =
        loaded(other).nodes[3].inertia_kg_m2.trace() / robot.nodes[3].inertia_kg_m2.trace();
    EXPECT_NEAR(share, 1, 1e-6) << times;
  }
}

TEST_F(ImportedFile, LongNamesStayOutsideTheController) {
  const model::Entity robot = loaded(import({.in_names = "_as_the_exporter_of_a_cad_calls_it"}));
  const Params params = model::make_params(robot);
  EXPECT_EQ(robot.joints[0].name, "jp2_as_the_exporter_of_a_cad_calls_it");
  EXPECT_EQ(std::string(params.joint[0].name).substr(0, 19), "jp2_as_the_exporte_");
  for (int j = 1; j < params.joint_count; ++j)
    EXPECT_STRNE(params.joint[j].name, params.joint[j - 1].name);
}

TEST_F(ImportedFile, MomentsThatNoBodyHasBecomeABallsAndAreSaid) {
  for (const double flatter : {-1.0, 2.5, 0.0}) {
    const Imported robot = import({.flatter = flatter});
    EXPECT_TRUE(was_changed(robot, "link p1: no body has its moments")) << flatter;
    const model::Entity entity = loaded(robot);
    expect_a_biped(entity);
    const model::Mat3& moments = entity.nodes[1].inertia_kg_m2;
    EXPECT_NEAR(moments(0, 0), moments(2, 2), 1e-9);
    EXPECT_NEAR(moments(0, 0) / entity.nodes[1].mass_kg, 4e-4 * std::max(1.0, flatter), 1e-5);
  }
}

TEST_F(ImportedFile, WhatAJointMovesHasAMassAndAGuessIsSaid) {
  for (const double foot_kg : {0.0, -1.0}) {
    const Imported robot = import({.foot_kg = foot_kg});
    EXPECT_TRUE(was_changed(robot, "link p4_5 has no mass")) << foot_kg;
    EXPECT_NEAR(model::total_mass(loaded(robot)), 1.2 + 2 * 0.2 + 10 * 0.1, 0.1);
  }
}

TEST_F(ImportedFile, ServosAreTheWeakestThatCarryTheRobotAndAreFastEnough) {
  const Imported robot = import({});
  EXPECT_EQ(finding(robot, "servos").sureness, Finding::Sureness::kGuessed);
  EXPECT_EQ(finding(robot, "servos").value.substr(0, 11), "xm430_w350,");
  const Imported heavy = import({.foot_kg = 20});
  EXPECT_EQ(finding(heavy, "servos").value.substr(0, 18), "a motor of 46 N m,");
  EXPECT_EQ(loaded(heavy).joints[4].servo.stall_torque_n_m, 46);
}

TEST_F(ImportedFile, LimitsOfMotorsStrongerThanAllKnownServosAreTheMotors) {
  const Imported robot = import({.foot_kg = 20, .effort_n_m = 40, .speed_rad_s = 8});
  EXPECT_EQ(finding(robot, "servos").sureness, Finding::Sureness::kRead);
  EXPECT_EQ(finding(robot, "servos").value.substr(0, 56),
            "motor_1 of 40 N m and 8 rad/s, its joints' <limit>, for ");
  EXPECT_EQ(finding(robot, "motor_1").sureness, Finding::Sureness::kGuessed);
  EXPECT_EQ(loaded(robot).joints[4].servo.most_torque_n_m(), 40);
  const Imported placeholder = import({.foot_kg = 20, .effort_n_m = 1000, .speed_rad_s = 100});
  EXPECT_EQ(finding(placeholder, "servos").value.substr(0, 18), "a motor of 46 N m,");
}

TEST_F(ImportedFile, ServosThatWalkWithALowerLiftOnlyGetOne) {
  urdf_ = folder_.path() / "robot.urdf";
  std::ofstream(urdf_) << Maker({.leg_joints = 5}).urdf();
  fs::create_directories(folder_.path() / "out");
  Wish wish{urdf_.string(), (folder_.path() / "out").string(), "", ""};
  for (int k = 0; k < 5; ++k) {
    for (const char* side : {"jp4_", "jp5_"}) {
      wish.source.drives[side + std::to_string(k)] = {
          .stall_torque_n_m = 3, .no_load_rad_s = 3.5, .is_line = true};
    }
  }
  const Imported robot = import_robot(wish);
  const std::string said = finding(robot, "lift").value;
  const GaitTuning gait = model::make_params(loaded_from_file(robot)).tuning.gait;
  EXPECT_LT(gait.lift_m, GaitTuning{}.lift_m);
  EXPECT_EQ(said.find(fmt::format("{:.2g} mm instead of 12, because joint 'jp4_3' would need 4.38 ",
                                  1000 * gait.lift_m)),
            0U)
      << said;
  EXPECT_EQ(finding(robot, "servo speed").value.find("enough for "), 0U);
}

TEST_F(ImportedFile, FrictionOfTheServosReplacesTheFilesAndThisIsSaid) {
  const model::Entity robot =
      loaded(import({.dynamics = "<dynamics damping=\"1000\" friction=\"0.5\"/>"}));
  for (const model::Joint& joint : robot.joints)
    EXPECT_EQ(joint.friction_n_m + joint.damping_n_m_s, 0) << joint.name;
  EXPECT_GT(robot.joints[0].servo.gearbox.f_base_n_m, 0);
}

/// Of 12 V and 0.1 ohm, 14 motors of 90 N m would leave 9 V when they rise.
TEST_F(ImportedFile, RobotOfThirtyKilogramsWalks) {
  session::WalkPlan plan;
  const Imported robot = import({.larger = 2.7, .heavier = 10});
  EXPECT_EQ(finding(robot, "supply").sureness, Finding::Sureness::kGuessed);
  plan.entity = loaded(robot);
  EXPECT_GT(model::total_mass(plan.entity), 27);
  plan.params = model::make_params(plan.entity);
  plan.velocity.vx_tenth_mm_s = 1500;
  plan.walk_s = 5;
  session::Options options;
  options.world.step_us = 2000;
  EXPECT_EQ(session::walk(plan, {}, options).failure, "");
}

TEST_F(ImportedFile, WhereHeavyLegsWouldStopTheWalkTheirFeetSwingCalmly) {
  const Imported robot =
      import({.sole_width_m = 0.03, .leg_kg = 0.3, .foot_kg = 0.4, .larger = 3.4, .heavier = 8});
  EXPECT_EQ(finding(robot, "swing").sureness, Finding::Sureness::kGuessed);
  Params params = model::make_params(loaded(robot));
  Command walk;
  walk.vx_tenth_mm_s = 1500;
  EXPECT_GT(session::kept_stride(params, walk), 0.95);
  params.tuning.gait.lift_m = 3.4F * GaitTuning{}.lift_m;
  params.tuning.gait.touchdown_m = 3.4F * GaitTuning{}.touchdown_m;
  EXPECT_LT(session::kept_stride(params, walk), 0.95) << "as it would be";
}

/// The twin's lidars scan in one plane, and its force-torque sensors are in joints that move.
TEST_F(ImportedFile, SensorsThatTheTwinLacksAreLeftOutAndSaid) {
  const std::string sensors =
      "<gazebo reference=\"p1\"><sensor name=\"lidar\" type=\"ray\"><ray><scan><horizontal>"
      "<samples>8</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal><vertical>"
      "<samples>16</samples><min_angle>-1</min_angle><max_angle>1</max_angle></vertical></scan>"
      "<range><min>0.1</min><max>9</max></range></ray></sensor>"
      "<sensor name=\"gyro\" type=\"imu\"/></gazebo>"
      "<gazebo reference=\"jp1\"><sensor name=\"load\" type=\"force_torque\"/></gazebo>";
  const Imported robot = import({.more = sensors});
  EXPECT_TRUE(was_changed(robot, "sensor lidar"));
  EXPECT_TRUE(was_changed(robot, "sensor load"));
  EXPECT_EQ(finding(robot, "IMU").sureness, Finding::Sureness::kRead);
  EXPECT_TRUE(loaded(robot).lasers.empty());
}

TEST_F(ImportedFile, ImuOutsideTheTrunkIsNotTheRobots) {
  const Imported robot =
      import({.more = "<gazebo reference=\"p2\"><sensor name=\"gyro\" type=\"imu\"/></gazebo>"});
  EXPECT_EQ(finding(robot, "IMU").sureness, Finding::Sureness::kGuessed);
  expect_a_biped(loaded(robot));
}

TEST_F(ImportedFile, WhatHasNoTwoLegsToWalkOnIsRefused) {
  for (const auto& [habits, said] :
       {std::pair{Habits{.leg_joints = 4, .has_hip_yaw = false}, "no leg is found"},
        {Habits{.leg_joints = 4}, "its legs have 4 joints"},
        {Habits{.leg_joints = 3}, "no leg is found"},
        {Habits{.has_rear_legs = true}, "it stands on four feet: 'p11_2'"},
        {Habits{.has_right_leg = false}, "only one leg is found"}}) {
    try {
      import(habits);
      ADD_FAILURE() << said;
    } catch (const model::LoadError& error) {
      EXPECT_NE(error.message.find(said), std::string::npos) << error.what();
      EXPECT_EQ(error.file, urdf_.string());
    }
  }
}

}  // namespace
}  // namespace verp::import
