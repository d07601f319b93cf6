#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <set>

#include "host/author/import/import.hpp"
#include "host/author/mjcf/mjcf.hpp"
#include "host/os/files/temporary_directory.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/import/refusal.hpp"

#ifdef VERP_HAS_MUJOCO
#include <mujoco/mujoco.h>
#endif

namespace verp::import {
namespace {

namespace fs = std::filesystem;

/// One leg, as MJCF files have it: degrees, classes in classes, childclass, no range on the yaw.
std::string leg(const std::string& side, double y_m) {
  return fmt::format(
      R"(<body name="{0}_yaw_body" pos="0 {1} -0.05" childclass="leg"><joint name="{0}_yaw" axis="0 0 1"/>
 <geom type="sphere" size="0.02"/>
 <body name="{0}_roll" euler="10 0 0"><joint name="{0}_roll" axis="1 0 0" range="-60 60"/>
  <geom type="box" size="0.01 0.02 0.015" mass="0.05" euler="-10 0 0"/>
 <body name="{0}_thigh" euler="-10 0 0"><joint name="{0}_pitch"/>
  <geom type="capsule" fromto="0 0 0 0 0 -0.1" size="0.012"/>
 <body name="{0}_shank" pos="0 0 -0.11"><joint name="{0}_knee" pos="0 0 0.01" range="-5 140"/>
  <geom type="cylinder" fromto="0 0 0 0 0 -0.08" size="0.01" density="1500"/>
 <body name="{0}_ankle" pos="0 0 -0.09"><joint name="{0}_ankle_pitch"/>
  <inertial pos="0 0 0" mass="0.06" fullinertia="4e-5 3e-5 2e-5 1e-6 0 0"/>
 <body name="{0}_foot"><joint name="{0}_ankle_roll" axis="1 0 0" class="foot"/>
  <geom class="sole" pos="0.012 0 -0.03"/>
 </body></body></body></body></body></body>)",
      side, y_m);
}

std::string robot(const std::string& inside = "", const std::string& outside = "") {
  return R"(<mujoco model="strange one">
<compiler inertiafromgeom="auto" autolimits="true"/>
<default><geom density="1200"/>
 <default class="leg"><joint axis="0 1 0" range="-100 100" armature="0.004" damping="0.3" frictionloss="0.02"/>
  <default class="foot"><joint range="-45 45"/></default>
  <default class="sole"><geom type="box" size="0.05 0.03 0.005" mass="0.08"/></default>
 </default>
 <position kp="20" forcerange="-3 3"/>
</default>
<worldbody><geom name="floor" type="plane" size="1 1 0.1"/>
 <body name="trunk" pos="0 0 0.4"><freejoint/>
  <geom type="box" size="0.04 0.06 0.05" mass="0.9"/><site name="chip" pos="0 0 0.02"/>)" +
         inside + leg("left", 0.04) + leg("right", -0.04) + R"(</body></worldbody>
<actuator>
 <position joint="left_yaw"/><position joint="left_roll"/><position joint="left_pitch"/>
 <position joint="left_knee"/><position joint="left_ankle_pitch"/><position joint="left_ankle_roll"/>
 <position joint="right_yaw"/><position joint="right_roll"/><position joint="right_pitch"/>
 <position joint="right_knee"/><position joint="right_ankle_pitch"/><position joint="right_ankle_roll"/>
</actuator>
<sensor><gyro site="chip"/></sensor>)" +
         outside + "</mujoco>";
}

class MjcfFile : public ::testing::Test {
 protected:
  std::string write(const std::string& text, const std::string& name = "robot.xml") {
    const fs::path path = folder_.path() / name;
    std::ofstream(path) << text;
    return path.string();
  }

  mjcf::Robot read(const std::string& text) { return mjcf::read_robot(write(text)); }

  Imported import(const std::string& text) {
    fs::remove(folder_.path() / "robot_from_mjcf.urdf");
    Wish wish{write(text), folder_.path().string(), "", ""};
    make_urdf(wish);
    return import_robot(wish);
  }

  static model::Entity loaded(const Imported& made) {
    EXPECT_EQ(made.refusal, "");
    return made.entity ? *made.entity : model::Entity();
  }

  std::string refusal(const std::string& text) {
    return import::refusal_of([&] { read(text); });
  }

  static const mjcf::Joint& joint(const mjcf::Robot& robot, const std::string& name) {
    static const mjcf::Joint kNone;
    for (const mjcf::Body& body : robot.bodies) {
      for (const mjcf::Joint& each : body.joints) {
        if (each.name == name) return each;
      }
    }
    ADD_FAILURE() << name;
    return kNone;
  }

  static bool lost(const std::vector<std::string>& list, const std::string& part) {
    for (const std::string& each : list) {
      if (each.find(part) != std::string::npos) return true;
    }
    return false;
  }

  files::TemporaryDirectory folder_;
};

TEST_F(MjcfFile, IsARobotThatLoads) {
  const Imported made = import(robot());
  const model::Entity entity = loaded(made);
  EXPECT_EQ(entity.joints.size(), 12U);
  EXPECT_EQ(model::find_limb(entity, "left_leg")->joints.size(), 6U);
  ASSERT_TRUE(entity.imu);
  for (const model::Joint& each : entity.joints) {
    EXPECT_NEAR(each.servo.stall_torque_n_m, 3, 1e-9) << each.name;
    EXPECT_NEAR(each.servo.no_load_speed_rad_s, 3 / 0.3, 1e-3) << "its damping is the back-EMF";
    EXPECT_NEAR(each.servo.gearbox.armature_kg_m2, 0.004, 1e-9) << each.name;
  }
  const model::Limb& leg = *model::find_limb(entity, "left_leg");
  EXPECT_NEAR(leg.sole_max_m.x() - leg.sole_min_m.x(), 0.1, 1e-4);
}

TEST_F(MjcfFile, MisspelledAttributesAreNamed) {
  const auto list = read(robot("<geom masss=\"1\" size=\"0.01\"/>")).left_out;
  EXPECT_TRUE(lost(list, "the attribute masss of <geom>, which MJCF has not"));
  EXPECT_FALSE(lost(read(robot()).left_out, "which MJCF has not"));
}

TEST_F(MjcfFile, SecondBodyOfANameIsRefused) {
  EXPECT_TRUE(refusal(robot("<body name=\"left_foot\"/>"))
                  .ends_with(": a second body is named 'left_foot'"));
}

TEST_F(MjcfFile, KeyframeOfAnotherLengthIsNamedAndNotTaken) {
  for (const char* const qpos : {"0 0 .3 1 0 0 0", "0 0 .3 1 0 0 0 1 2 3 4 5 6 7 8 9 10 11"}) {
    const mjcf::Robot made =
        read(robot("", fmt::format("<keyframe><key name=\"home\" qpos=\"{}\"/></keyframe>", qpos)));
    EXPECT_TRUE(lost(made.left_out, "keyframe 'home': its qpos has")) << qpos;
    EXPECT_TRUE(made.stand.empty()) << qpos;
  }
}

TEST_F(MjcfFile, ServosTooSlowToWalkAreSaidWithBothSpeeds) {
  std::string text = robot();
  text.replace(text.find("damping=\"0.3\""), 13, "damping=\"1.8\"");
  const Imported made = import(text);
  const auto said = std::find_if(made.findings.begin(), made.findings.end(),
                                 [](const Finding& each) { return each.what == "servo speed"; });
  ASSERT_NE(said, made.findings.end());
  EXPECT_EQ(said->value,
            "too low to walk: even on the spot joint 'left_knee' needs up to 3.32 rad/s, and its "
            "servo turns 1.67; servos of 2.65 rad/s would do");
  EXPECT_NE(said->check.find("the file's torque over its damping"), std::string::npos);
  EXPECT_NE(page_of(made, {}).find(said->value), std::string::npos);
}

TEST_F(MjcfFile, MoreKindsOfMotorsThanTheControllerHasRoomForAreMerged) {
  std::string text = robot();
  double force_n_m = 3;
  for (const char* const joint : {"yaw", "roll", "pitch", "knee", "ankle_pitch", "ankle_roll"}) {
    for (const char* const side : {"left", "right"}) {
      const std::string name = fmt::format("joint=\"{}_{}\"/>", side, joint);
      const std::size_t at = text.find("<position " + name) + 10;
      text.insert(at, fmt::format("forcerange=\"-{0} {0}\" ", force_n_m));
    }
    force_n_m *= 1.5;
  }
  const model::Entity entity = loaded(import(text));
  EXPECT_TRUE(lost(entity.notes, "room for 4 kinds"));
  std::set<int> gains;
  for (const model::Joint& each : entity.joints) gains.insert(each.servo.p_gain);
  EXPECT_EQ(gains.size(), 4U);
  EXPECT_NO_THROW(model::make_params(entity));
}

TEST_F(MjcfFile, ClassesGiveWhatTheElementLeavesOut) {
  const mjcf::Robot made = read(robot());
  EXPECT_NEAR(joint(made, "left_pitch").upper, 100 * M_PI / 180, 1e-9);
  EXPECT_NEAR(joint(made, "left_knee").lower, -5 * M_PI / 180, 1e-9);
  EXPECT_NEAR(joint(made, "left_ankle_roll").upper, 45 * M_PI / 180, 1e-9);
  EXPECT_NEAR(joint(made, "left_ankle_roll").motor.damping_n_m_s, 0.3, 1e-9);
  EXPECT_EQ(joint(made, "left_roll").axis, mjcf::Vec3::UnitX());
}

TEST_F(MjcfFile, JointKeepsItsNameWhereABodyHasTheSame) {
  const mjcf::Robot made = read(robot());
  EXPECT_EQ(joint(made, "left_roll").name, "left_roll");
  EXPECT_EQ(made.bodies[2].name, "left_roll_link");
}

TEST_F(MjcfFile, AnglesAreInRadiansWhereTheCompilerSaysSo) {
  std::string text =
      robot("<body><joint name=\"neck\" range=\"-1 2\"/><geom size=\"0.01\"/></body>");
  text.replace(text.find("<compiler "), 10, "<compiler angle=\"radian\" ");
  EXPECT_EQ(joint(read(text), "neck").upper, 2);
}

TEST_F(MjcfFile, JointsOfOneBodyBecomeAChain) {
  const std::string text = robot(
      "<body name=\"head\" pos=\"0 0 0.1\"><joint name=\"pan\"/><joint name=\"tilt\" axis=\"0 1 "
      "0\"/>"
      "<geom type=\"ellipsoid\" size=\"0.03 0.02 0.03\" mass=\"0.1\"/></body>");
  const Imported made = import(text);
  const model::Entity entity = loaded(made);
  EXPECT_EQ(entity.joints.size(), 14U);
  EXPECT_NEAR(model::total_mass(entity), model::total_mass(loaded(import(robot()))) + 0.1, 1e-6);
  EXPECT_TRUE(lost(made.left_out, "body head turns by 2 joints"));
  EXPECT_TRUE(lost(made.left_out, "ellipsoids"));
}

TEST_F(MjcfFile, KeyframeGivesTheArmsTheirPose) {
  std::string arms;
  for (const char* side : {"left", "right"}) {
    arms += fmt::format(
        "<body name=\"{0}_arm\" pos=\"0 {1} 0.04\"><joint name=\"{0}_arm\" axis=\"1 0 0\" "
        "range=\"-90 90\"/><geom type=\"capsule\" fromto=\"0 0 0 0 0 -0.1\" size=\"0.01\"/></body>",
        side, side[0] == 'l' ? 0.09 : -0.09);
  }
  std::string qpos = "0 0 0.4 1 0 0 0 0.3 -0.3";
  for (int i = 0; i < 12; ++i) qpos += " 0";
  const model::Entity entity = loaded(
      import(robot(arms, "<keyframe><key name=\"home\" qpos=\"" + qpos + "\"/></keyframe>")));
  for (const model::Joint& each : entity.joints) {
    const double wanted_rad = each.name == "left_arm" ? 0.3 : -0.3;
    if (each.name.find("arm") != std::string::npos) {
      EXPECT_NEAR(each.stand_rad, wanted_rad, 1e-6);
    }
  }
}

TEST_F(MjcfFile, OfSeveralBodiesTheOneWithMostJointsIsTheRobot) {
  std::string text = robot();
  text.insert(text.find("<body name=\"trunk\""),
              "<body name=\"ball\"><freejoint/><geom size=\"0.05\"/></body>");
  const mjcf::Robot made = read(text);
  EXPECT_EQ(made.bodies.front().name, "trunk");
  EXPECT_TRUE(lost(made.left_out, "ball"));
}

TEST_F(MjcfFile, IncludeWithoutAnEndIsRefused) {
  EXPECT_TRUE(
      refusal("<mujoco><include file=\"/dev/zero\"/></mujoco>").ends_with("cannot be read"));
}

TEST_F(MjcfFile, IncludesAreReadInTheirPlace) {
  write("<mujoco>" + leg("left", 0.04) + "</mujoco>", "left.xml");
  std::string text = robot();
  text.replace(text.find(leg("left", 0.04)), leg("left", 0.04).size(),
               "<include file=\"left.xml\"/><include file=\"absent.xml\"/>");
  const mjcf::Robot made = read(text);
  EXPECT_EQ(made.bodies.size(), 13U);
  EXPECT_TRUE(lost(made.left_out, "absent.xml"));
  write("<mujoco><include file=\"left.xml\"/></mujoco>", "left.xml");
  EXPECT_NE(refusal(text).find("have no end"), std::string::npos);
}

TEST_F(MjcfFile, NothingVanishesWithoutAWord) {
  const mjcf::Robot made = read(robot(
      "<body name=\"tail\"><joint type=\"ball\" name=\"hip\"/><geom size=\"0.01\"/></body>"
      "<body gravcomp=\"1\"><joint name=\"spring\" stiffness=\"3\"/><geom size=\"0.01\"/></body>",
      "<tendon><fixed name=\"t\"><joint joint=\"spring\" coef=\"1\"/></fixed></tendon>"
      "<equality><connect body1=\"tail\" anchor=\"0 0 0\"/></equality>"));
  for (const char* what : {"ball joint", "stiffness", "tendons", "loops", "gravcomp", "floor"})
    EXPECT_TRUE(lost(made.left_out, what)) << what;
}

TEST_F(MjcfFile, WrongNumbersAreRefusedAtTheirLine) {
  const auto with = [](const std::string& inside) { return robot("\n" + inside); };
  EXPECT_NE(refusal(with("<body quat=\"0 0 0 0\"/>")).find("13: quat is zero"), std::string::npos);
  EXPECT_NE(refusal(with("<body pos=\"0 0\"/>")).find("is not 3 numbers"), std::string::npos);
  EXPECT_NE(refusal(with("<body pos=\"0 0 nan\"/>")).find("is not 3 numbers"), std::string::npos);
  EXPECT_NE(refusal(with("<body><joint axis=\"0 0 0\"/></body>")).find("axis"), std::string::npos);
  EXPECT_NE(refusal(with("<geom type=\"box\" size=\"1\"/>")).find("3 sizes"), std::string::npos);
  EXPECT_NE(refusal(with("<geom class=\"none\"/>")).find("no class 'none'"), std::string::npos);
  EXPECT_NE(refusal(with("<geom mesh=\"none\"/>")).find("no mesh 'none'"), std::string::npos);
  EXPECT_NE(refusal(with("<inertial mass=\"-1\"/>")).find("negative"), std::string::npos);
  EXPECT_NE(refusal("<mujoco/>").find("1: no <body>"), std::string::npos);
}

#ifdef VERP_HAS_MUJOCO
using Model = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;
using Data = std::unique_ptr<mjData, decltype(&mj_deleteData)>;

Model mujoco(const std::string& file) {
  char error[1000] = "";
  Model model(mj_loadXML(file.c_str(), nullptr, error, sizeof error), &mj_deleteModel);
  EXPECT_TRUE(model) << error;
  return model;
}

/// The joint-space inertia at these angles, without rotors, in the order of `names`.
Eigen::MatrixXd inertia(const Model& model, const std::vector<std::string>& names,
                        const std::vector<double>& angle) {
  Data data(mj_makeData(model.get()), &mj_deleteData);
  std::vector<int> dof;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int joint = mj_name2id(model.get(), mjOBJ_JOINT, names[i].c_str());
    EXPECT_GE(joint, 0) << names[i];
    data->qpos[model->jnt_qposadr[joint]] = angle[i];
    dof.push_back(model->jnt_dofadr[joint]);
  }
  mj_forward(model.get(), data.get());
  Eigen::Matrix<double, -1, -1, Eigen::RowMajor> full(model->nv, model->nv);
  mj_fullM(model.get(), full.data(), data->qM);
  Eigen::MatrixXd out(names.size(), names.size());
  for (std::size_t r = 0; r < dof.size(); ++r) {
    for (std::size_t c = 0; c < dof.size(); ++c) {
      out(static_cast<int>(r), static_cast<int>(c)) =
          full(dof[r], dof[c]) - (r == c ? model->dof_armature[dof[r]] : 0);
    }
  }
  return out;
}

TEST_F(MjcfFile, MuJoCoFindsTheSameInertiaInTheUrdfThatWeMake) {
  const std::string file = write(
      robot("<body name=\"head\" pos=\"0.01 0 0.1\" quat=\"0.9 0.1 0.2 0.3\"><joint name=\"pan\" "
            "ref=\"20\" "
            "pos=\"0.01 0.02 0\" axis=\"1 2 3\"/><geom type=\"ellipsoid\" size=\"0.03 0.02 0.04\"/>"
            "<body axisangle=\"1 1 0 30\" pos=\"0 0 0.1\"><geom type=\"capsule\" size=\"0.01 "
            "0.03\"/></body>"
            "</body>"));
  const std::string urdf = (folder_.path() / "made.urdf").string();
  std::ofstream(urdf) << read_source(file, folder_.path().string()).urdf;
  const Model theirs = mujoco(file), ours = mujoco(urdf);
  ASSERT_TRUE(theirs && ours);
  std::vector<std::string> names = {"pan"};
  for (const mjcf::Body& body : mjcf::read_robot(file).bodies) {
    for (const mjcf::Joint& each : body.joints) {
      if (each.name != "pan") names.push_back(each.name);
    }
  }
  EXPECT_EQ(names.size(), 13U);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-0.8, 0.8);
  for (int i = 0; i < 20; ++i) {
    std::vector<double> angles;
    for (std::size_t j = 0; j < names.size(); ++j) angles.push_back(angle(random));
    const Eigen::MatrixXd difference =
        inertia(theirs, names, angles) - inertia(ours, names, angles);
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-9);
  }
}

/// Centres of mass in the frame of the body, from VERP's own tree.
std::vector<model::Vec3> centres(const model::Entity& entity, const std::vector<double>& angle) {
  std::vector<model::Transform> pose(entity.nodes.size(), model::Transform::Identity());
  std::vector<model::Vec3> out(entity.nodes.size());
  for (const std::size_t j : model::outward(entity)) {
    const model::Joint& joint = entity.joints[j];
    pose[j + 1] = pose[static_cast<std::size_t>(joint.parent)] *
                  Eigen::Translation3d(joint.origin_m) * Eigen::AngleAxisd(angle[j], joint.axis);
  }
  for (std::size_t i = 0; i < pose.size(); ++i) out[i] = pose[i] * entity.nodes[i].com_m;
  return out;
}

class ShippedRobot : public ::testing::TestWithParam<const char*> {
 protected:
  ShippedRobot() : entity_(model::load_robot(model::find_model(GetParam()))) {
    for (const auto& [file, text_of] :
         {std::pair{&mjcf_, &mjcf::mjcf_of}, std::pair{&urdf_, &mjcf::urdf_of}}) {
      mjcf::Robot robot = mjcf::robot_of(entity_);
      std::ofstream(*file) << text_of(robot, folder_.path().string());
    }
    for (const model::Joint& joint : entity_.joints) names_.push_back(joint.name);
  }

  files::TemporaryDirectory folder_;
  std::string mjcf_ = (folder_.path() / "robot.xml").string();
  std::string urdf_ = (folder_.path() / "robot.urdf").string();
  model::Entity entity_;
  std::vector<std::string> names_;
};

TEST_P(ShippedRobot, HasTheSameMassesPlacesAndInertiasInMuJoCo) {
  const Model as_mjcf = mujoco(mjcf_), as_urdf = mujoco(urdf_);
  ASSERT_TRUE(as_mjcf && as_urdf);
  Data data(mj_makeData(as_mjcf.get()), &mj_deleteData);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-0.8, 0.8);
  for (int round = 0; round < 10; ++round) {
    std::vector<double> angles;
    for (const std::string& name : names_) {
      const int joint = mj_name2id(as_mjcf.get(), mjOBJ_JOINT, name.c_str());
      ASSERT_GE(joint, 0) << name;
      angles.push_back(angle(random));
      data->qpos[as_mjcf->jnt_qposadr[joint]] = angles.back();
    }
    mj_forward(as_mjcf.get(), data.get());
    const auto expected = centres(entity_, angles);
    for (std::size_t i = 0; i < entity_.nodes.size(); ++i) {
      const model::Node& node = entity_.nodes[i];
      const int body = mj_name2id(as_mjcf.get(), mjOBJ_BODY, node.name.c_str());
      ASSERT_GE(body, 0) << node.name;
      const double* const at = data->xipos + 3 * body;
      const model::Vec3 moved(at[0], at[1], at[2] - data->qpos[2]);
      EXPECT_LT((moved - expected[i]).norm(), 1e-6) << node.name;
      EXPECT_NEAR(as_mjcf->body_mass[body], node.mass_kg, 1e-9) << node.name;
      const double* const moments = as_mjcf->body_inertia + 3 * body;
      EXPECT_NEAR(moments[0] + moments[1] + moments[2], node.inertia_kg_m2.trace(), 1e-9);
    }
    EXPECT_LT(
        (inertia(as_mjcf, names_, angles) - inertia(as_urdf, names_, angles)).cwiseAbs().maxCoeff(),
        1e-9);
  }
}

TEST_P(ShippedRobot, StandsInMuJoCo) {
  const Model model = mujoco(mjcf_);
  ASSERT_TRUE(model);
  Data data(mj_makeData(model.get()), &mj_deleteData);
  mj_resetDataKeyframe(model.get(), data.get(), 0);
  const double height_m = data->qpos[2];
  for (int i = 0; i < model->nu; ++i)
    data->ctrl[i] = data->qpos[model->jnt_qposadr[model->actuator_trnid[2 * i]]];
  for (int step = 0; step < 1500; ++step) mj_step(model.get(), data.get());
  EXPECT_NEAR(data->qpos[2], height_m, 0.1 * height_m);
}

INSTANTIATE_TEST_SUITE_P(InOtherFormats, ShippedRobot,
                         ::testing::Values("generic21", "op3", "darwin_op"),
                         [](const auto& each) { return std::string(each.param); });
#endif

}  // namespace
}  // namespace verp::import
