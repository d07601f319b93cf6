#include "host/author/plain_sdf/plain_sdf.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "host/author/import/import.hpp"
#include "host/os/files/temporary_directory.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "tests/host/import/refusal.hpp"

namespace verp::plain_sdf {
namespace {

namespace fs = std::filesystem;
using import::Imported;
using import::Wish;
using model::Transform;
using model::Vec3;

std::string link(const std::string& name, const std::string& pose, double kg,
                 const std::string& size, const std::string& more = "") {
  return fmt::format(
      "<link name=\"{0}\">{1}<inertial><pose>0 0 -0.01 0 0 0</pose><mass>{2}</mass><inertia>"
      "<ixx>{3}</ixx><iyy>{3}</iyy><izz>{3}</izz></inertia></inertial><collision name=\"{0}_box\">"
      "<geometry><box><size>{4}</size></box></geometry></collision>{5}</link>\n",
      name, pose, kg, kg * 4e-4, size, more);
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& axis, const std::string& more = "") {
  return fmt::format(
      "<joint name=\"{}\" type=\"revolute\">{}<parent>{}</parent><child>{}</child><axis>{}"
      "<limit><lower>-1.6</lower><upper>1.6</upper><effort>9</effort><velocity>7</velocity></limit>"
      "</axis></joint>\n",
      name, more, parent, child, axis);
}

/// A leg that hangs at (0, y, 0.3); links are placed in the model.
std::string leg(const std::string& side, double y_m) {
  const char* const names[] = {"yaw", "roll", "pitch", "knee", "ankle_pitch", "ankle_roll"};
  const char* const axes[] = {"0 0 1", "1 0 0", "0 1 0", "0 1 0", "0 1 0", "1 0 0"};
  const double heights_m[] = {0.3, 0.29, 0.29, 0.19, 0.09, 0.09};
  std::string text, above = "trunk";
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string below = side + "_" + names[i] + "_link";
    const std::string pose = fmt::format("<pose>0 {} {} 0 0 0</pose>", y_m, heights_m[i]);
    const bool is_foot = i == 5;
    text += is_foot ? link(below, pose, 0.1, "0.02 0.02 0.02",
                           "<collision name=\"sole\"><pose>0.01 0 -0.04 0 0 0</pose><geometry><box>"
                           "<size>0.11 0.07 0.02</size></box></geometry></collision>")
                    : link(below, pose, 0.12, "0.02 0.02 0.02");
    text += joint(side + "_" + names[i], above, below, fmt::format("<xyz>{}</xyz>", axes[i]));
    above = below;
  }
  return text;
}

std::string trunk(const std::string& inside = "") {
  return link("trunk", "<pose>0 0 0.4 0 0 0</pose>", 1.2, "0.08 0.12 0.1", inside);
}

std::string sdf(const std::string& inside, const std::string& version = "1.9") {
  return "<sdf version=\"" + version + "\"><model name=\"stranger\">\n" + inside + "</model></sdf>";
}

std::string robot(const std::string& more = "", const std::string& in_trunk = "") {
  return sdf(trunk(in_trunk) + leg("left", 0.04) + leg("right", -0.04) + more);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return at == text.npos ? text : text.replace(at, from.size(), to);
}

class SdfFile : public ::testing::Test {
 protected:
  std::string write(const std::string& text, const std::string& name = "robot.sdf") {
    const fs::path path = folder_.path() / "theirs" / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path.string();
  }

  mjcf::Robot read(const std::string& text) { return read_robot(write(text)); }

  Imported imported(const std::string& text) {
    const fs::path folder = folder_.path() / "ours";
    fs::remove_all(folder);
    fs::create_directories(folder);
    Wish wish{write(text), folder.string(), "", ""};
    import::make_urdf(wish);
    Imported made = import::import_robot(wish);
    std::ofstream(folder / "robot.sdf") << made.sdf;
    return made;
  }

  model::Entity loaded(const std::string& text) {
    const Imported made = imported(text);
    EXPECT_EQ(made.refusal, "");
    return model::load_robot((folder_.path() / "ours" / "robot.sdf").string());
  }

  std::string refusal(const std::string& text) {
    return import::refusal_of([&] { read(text); });
  }

  static Transform place(const mjcf::Robot& robot, int body) {
    const mjcf::Body& own = robot.bodies[static_cast<std::size_t>(body)];
    return own.parent < 0 ? own.pose : place(robot, own.parent) * own.pose;
  }

  static int find(const mjcf::Robot& robot, const std::string& name) {
    for (std::size_t i = 0; i < robot.bodies.size(); ++i) {
      if (robot.bodies[i].name == name) return static_cast<int>(i);
    }
    ADD_FAILURE() << "no body " << name;
    return 0;
  }

  /// Bodies, joints, masses and shapes at the same places from the trunk.
  static void expect_same(const mjcf::Robot& one, const mjcf::Robot& other) {
    ASSERT_EQ(one.bodies.size(), other.bodies.size());
    const Transform from = place(other, find(other, "trunk")).inverse();
    const Transform base = place(one, find(one, "trunk")).inverse();
    for (std::size_t i = 0; i < one.bodies.size(); ++i) {
      const mjcf::Body& a = one.bodies[i];
      const int at = find(other, a.name);
      const mjcf::Body& b = other.bodies[static_cast<std::size_t>(at)];
      const Transform pose_a = base * place(one, static_cast<int>(i)),
                      pose_b = from * place(other, at);
      EXPECT_TRUE((pose_a * a.inertial->pose).isApprox(pose_b * b.inertial->pose, 1e-6)) << a.name;
      EXPECT_NEAR(a.inertial->mass_kg, b.inertial->mass_kg, 1e-12) << a.name;
      ASSERT_EQ(a.geoms.size(), b.geoms.size()) << a.name;
      for (std::size_t k = 0; k < a.geoms.size(); ++k) {
        EXPECT_TRUE((pose_a * a.geoms[k].pose).isApprox(pose_b * b.geoms[k].pose, 1e-6)) << a.name;
      }
      ASSERT_EQ(a.joints.size(), b.joints.size()) << a.name;
      if (a.joints.empty()) continue;
      EXPECT_EQ(a.joints[0].name, b.joints[0].name);
      EXPECT_NEAR((pose_a * a.joints[0].at_m - pose_b * b.joints[0].at_m).norm(), 0, 1e-6)
          << a.name;
      EXPECT_NEAR((pose_a.linear() * a.joints[0].axis - pose_b.linear() * b.joints[0].axis).norm(),
                  0, 1e-6)
          << a.name;
    }
  }

  static std::string lost(const mjcf::Robot& robot, const std::string& part) {
    for (const std::string& each : robot.left_out) {
      if (each.find(part) != std::string::npos) return each;
    }
    return "";
  }

  files::TemporaryDirectory folder_;
};

void drop_ours(tinyxml2::XMLElement& element) {
  for (auto* child = element.FirstChildElement(); child != nullptr;) {
    auto* const next = child->NextSiblingElement();
    if (std::string(child->Name()).starts_with("verp:")) {
      element.DeleteChild(child);
    } else {
      drop_ours(*child);
    }
    child = next;
  }
}

Vec3 place_of(const model::Entity& robot, std::size_t joint) {
  Vec3 at = robot.joints[joint].origin_m;
  for (int node = robot.joints[joint].parent; node > 0;
       node = robot.joints[static_cast<std::size_t>(node - 1)].parent) {
    at += robot.joints[static_cast<std::size_t>(node - 1)].origin_m;
  }
  return at;
}

TEST_F(SdfFile, AShippedRobotWithoutOurElementsBecomesTheSameRobot) {
  for (const char* const name : {"op3", "microduck"}) {
    const std::string path = model::find_model(name);
    tinyxml2::XMLDocument document;
    ASSERT_EQ(document.LoadFile(path.c_str()), tinyxml2::XML_SUCCESS);
    drop_ours(*document.RootElement());
    tinyxml2::XMLPrinter text;
    document.Print(&text);
    const model::Entity ours = model::load_robot(path), made = loaded(text.CStr());
    ASSERT_EQ(made.joints.size(), ours.joints.size()) << name;
    for (const model::Limb& limb : ours.limbs)
      EXPECT_NE(model::find_limb(made, limb.name), nullptr) << name << " " << limb.name;
    for (std::size_t i = 0; i < ours.joints.size(); ++i) {
      const model::Joint& a = ours.joints[i];
      std::size_t k = 0;
      while (k + 1 < made.joints.size() && made.joints[k].name != a.name) ++k;
      const model::Joint& b = made.joints[k];
      ASSERT_EQ(b.name, a.name);
      EXPECT_NEAR((a.axis - b.axis).norm(), 0, 1e-5) << a.name;
      EXPECT_NEAR(a.lower_rad, b.lower_rad, 1e-5) << a.name;
      EXPECT_NEAR(ours.nodes[i + 1].mass_kg, made.nodes[k + 1].mass_kg, 1e-9) << a.name;
      EXPECT_NEAR((ours.nodes[i + 1].com_m - made.nodes[k + 1].com_m).norm(), 0, 1e-6) << a.name;
      EXPECT_NEAR((ours.nodes[i + 1].inertia_kg_m2 - made.nodes[k + 1].inertia_kg_m2).norm(), 0,
                  1e-9)
          << a.name;
      const Vec3 trunk_shift = place_of(ours, 0) - place_of(ours, i);
      std::size_t first = 0;
      while (made.joints[first].name != ours.joints[0].name) ++first;
      EXPECT_NEAR((trunk_shift - (place_of(made, first) - place_of(made, k))).norm(), 0, 1e-6)
          << a.name;
    }
  }
}

TEST_F(SdfFile, IsARobotThatLoads) {
  const model::Entity entity = loaded(robot());
  EXPECT_EQ(entity.joints.size(), 12U);
  ASSERT_NE(model::find_limb(entity, "left_leg"), nullptr);
  EXPECT_EQ(model::find_limb(entity, "left_leg")->joints.size(), 6U);
}

TEST_F(SdfFile, PosesInOtherFramesAndUnitsAreTheSamePlaces) {
  const mjcf::Robot plain = read(robot());
  std::string text = robot(
      "<frame name=\"hip\" attached_to=\"trunk\"><pose>0 0.04 -0.1 0 0 "
      "1.5707963267949</pose></frame>"
      "<frame name=\"low\"><pose relative_to=\"hip\">0 0 -0.21 0 0 0</pose></frame>");
  text = replaced(text, "<pose>0 0.04 0.19 0 0 0</pose>",
                  "<pose relative_to=\"left_knee\">0 0 0 0 0 0</pose>");
  text = replaced(text, "<joint name=\"left_knee\" type=\"revolute\">",
                  "<joint name=\"left_knee\" type=\"revolute\"><pose degrees=\"true\" "
                  "relative_to=\"left_pitch_link\">0 0 -0.1 0 0 0</pose>");
  text = replaced(text, "<pose>0 0.04 0.3 0 0 0</pose>", "<pose relative_to=\"hip\"/>");
  text = replaced(text, "<pose>0 0 -0.01 0 0 0</pose><mass>0.12</mass>",
                  "<pose relative_to=\"trunk\">0 0.04 -0.11 0 0 1.5707963267949</pose>"
                  "<mass>0.12</mass>");
  text =
      replaced(text, "<collision name=\"left_yaw_link_box\">",
               "<collision name=\"left_yaw_link_box\"><pose degrees=\"true\">0 0 0 0 0 0</pose>");
  text = replaced(text, "<pose>0 0.04 0.09 0 0 0</pose>",
                  "<pose relative_to=\"low\" rotation_format=\"quat_xyzw\">0 0 0\n 0 0 "
                  "-0.70710678118655 0.70710678118655</pose>");
  const mjcf::Robot other = read(text);
  const int yaw = find(other, "left_yaw_link");
  EXPECT_NEAR(other.bodies[static_cast<std::size_t>(yaw)].pose.linear()(1, 0), 1, 1e-9);
  EXPECT_EQ(plain.bodies.size(), other.bodies.size());
  EXPECT_TRUE(place(plain, find(plain, "left_ankle_roll_link"))
                  .isApprox(place(other, find(other, "left_ankle_roll_link")), 1e-6));
  EXPECT_TRUE(place(plain, find(plain, "left_ankle_pitch_link"))
                  .isApprox(place(other, find(other, "left_ankle_pitch_link")), 1e-6));
  EXPECT_TRUE(
      (place(plain, 1) * plain.bodies[1].inertial->pose)
          .translation()
          .isApprox((place(other, yaw) * other.bodies[static_cast<std::size_t>(yaw)].inertial->pose)
                        .translation(),
                    1e-6));
}

TEST_F(SdfFile, AnAxisIsTakenInTheFrameThatItNames) {
  const mjcf::Robot plain = read(robot());
  std::string text = robot("<frame name=\"side\"><pose>0 0 0 0 0 1.5707963267949</pose></frame>");
  text = replaced(text, "<child>left_pitch_link</child><axis><xyz>0 1 0</xyz>",
                  "<child>left_pitch_link</child><axis><xyz expressed_in=\"side\">1 0 0</xyz>");
  text = replaced(text, "<joint name=\"left_roll\" type=\"revolute\">",
                  "<joint name=\"left_roll\" type=\"revolute\"><pose>0 0 0 0 0 1.5707963267949"
                  "</pose>");
  text = replaced(text, "<child>left_roll_link</child><axis><xyz>1 0 0</xyz>",
                  "<child>left_roll_link</child><axis><xyz>0 -2 0</xyz>");
  expect_same(plain, read(text));
}

TEST_F(SdfFile, BeforeSdf15AxesAreTheModels) {
  const auto turned = [](const std::string& version, const std::string& more) {
    return sdf(trunk() + link("arm", "<pose>0 0 0.5 0 0 1.5707963267949</pose>", 0.1, "1 1 1") +
                   joint("turn", "trunk", "arm", "<xyz>1 0 0</xyz>" + more),
               version);
  };
  const auto axis = [&](const mjcf::Robot& made) {
    return Vec3(place(made, 1).linear() * made.bodies[1].joints[0].axis);
  };
  const std::string flag = "<use_parent_model_frame>true</use_parent_model_frame>";
  EXPECT_TRUE(axis(read(turned("1.4", ""))).isApprox(Vec3::UnitX(), 1e-9));
  EXPECT_TRUE(axis(read(turned("1.6", flag))).isApprox(Vec3::UnitX(), 1e-9));
  EXPECT_TRUE(axis(read(turned("1.6", ""))).isApprox(Vec3::UnitY(), 1e-9));
  EXPECT_TRUE(axis(read(turned("1.11", ""))).isApprox(Vec3::UnitY(), 1e-9));
}

TEST_F(SdfFile, IncludedNestedAndMergedModelsAreOneRobot) {
  const mjcf::Robot plain = read(robot());
  const auto alone = [](const std::string& side, double y_m) {
    std::string text = leg(side, y_m);
    const std::size_t at = text.find("<joint name=\"" + side + "_yaw\"");
    text.erase(at, text.find("</joint>", at) + 9 - at);
    return sdf(text + "<frame name=\"top\" attached_to=\"" + side + "_yaw_link\"/>");
  };
  write(alone("left", 0.5), "leg/left.sdf");
  write("<model><sdf version=\"1.5\">old.sdf</sdf><sdf version=\"1.9\">left.sdf</sdf></model>",
        "leg/model.config");
  write(alone("right", -0.04), "right.sdf");
  const mjcf::Robot made = read(
      sdf(trunk() +
          "<include><uri>model://leg</uri><name>one</name><placement_frame>top</placement_frame>"
          "<pose relative_to=\"trunk\">0 0.04 -0.1 0 0 0</pose></include>" +
          "<include merge=\"true\"><uri>right.sdf</uri></include>" +
          joint("left_yaw", "trunk", "one::left_yaw_link",
                "<xyz expressed_in=\"__model__\">0 0 1</xyz>") +
          joint("right_yaw", "trunk", "right_yaw_link", "<xyz>0 0 1</xyz>")));
  expect_same(plain, made);
}

TEST_F(SdfFile, PartsThatNestedModelsNameAlikeKeepTheirModelsName) {
  const std::string arm = link("tip", "", 0.1, "0.1 0.1 0.1");
  const mjcf::Robot made =
      read(sdf(trunk() + "<model name=\"a\">" + arm + "</model><model name=\"b\">" + arm +
               "</model>" + joint("one", "trunk", "a::tip", "<xyz>0 0 1</xyz>") +
               joint("two", "trunk", "b::tip", "<xyz>0 0 1</xyz>")));
  EXPECT_GT(find(made, "a_tip"), 0);
  EXPECT_GT(find(made, "b_tip"), 0);
}

TEST_F(SdfFile, OfAWorldTheModelWithMostJointsIsTheRobotAndStandsAsThere) {
  std::string model = robot();
  model = model.substr(model.find("<model"));
  model.resize(model.rfind("</sdf>"));
  const std::string text =
      "<sdf version=\"1.7\"><world name=\"w\"><include><uri>model://sun_of_nobody</uri></include>"
      "<model name=\"ground\"><static>true</static>" +
      link("plate", "", 1, "9 9 1") + "</model>" +
      replaced(model, "\"stranger\">", "\"stranger\"><pose>3 0 1 0 0 1.5707963267949</pose>") +
      "</world></sdf>";
  const mjcf::Robot made = read(text);
  EXPECT_EQ(made.name, "stranger");
  EXPECT_EQ(lost(made, "beside"), "models beside the robot (ground)");
  EXPECT_NEAR(place(made, find(made, "trunk")).linear()(1, 0), 1, 1e-9);
  EXPECT_EQ(imported(text).refusal, "");
}

TEST_F(SdfFile, WhatARobotOfOursHasNotIsListedByName) {
  const mjcf::Robot made = read(robot(
      "<static>true</static><plugin filename=\"libdrive.so\" name=\"drive\"><x/></plugin>"
      "<link name=\"loose\"><gravity>0</gravity></link>"
      "<joint name=\"stand\" type=\"fixed\"><parent>world</parent><child>trunk</child></joint>",
      "<sensor name=\"eye\" type=\"camera\"/><visual name=\"v\"><geometry><mesh><uri>"
      "model://nowhere/a.dae</uri></mesh></geometry></visual><visual name=\"p\"><geometry><plane/>"
      "</geometry></visual>"));
  for (const char* const line :
       {"<static>: the robot moves (stranger)", "plugins (drive)",
        "links that no joint holds (loose)", "joints to the world: the robot stands free (stand)",
        "sensors (eye (camera))", "meshes that are not there (model://nowhere/a.dae)",
        "shapes of type plane (p)"}) {
    EXPECT_EQ(lost(made, line), line);
  }
}

TEST_F(SdfFile, AnImuIsWhereItsPoseSays) {
  const model::Entity entity =
      loaded(robot("",
                   "<sensor name=\"chip\" type=\"imu\"><pose>0.01 0 0.02 0 0 1.5707963267949</pose>"
                   "</sensor>"));
  ASSERT_TRUE(entity.imu);
  EXPECT_NEAR(entity.imu->pose.linear()(1, 0), 1, 1e-5);
  EXPECT_NEAR(entity.imu->pose.translation().x(), 0.01, 1e-5);
}

TEST_F(SdfFile, ALoopIsOpenedAndAJointMayPointToTheTrunk) {
  const mjcf::Robot plain = read(robot());
  std::string text =
      robot(joint("rod", "left_knee_link", "left_ankle_roll_link", "<xyz>0 1 0</xyz>"));
  EXPECT_NE(lost(read(text), "loop"), "");
  text = replaced(robot(), "<parent>trunk</parent><child>left_yaw_link</child><axis><xyz>0 0 1",
                  "<pose relative_to=\"left_yaw_link\"/><parent>left_yaw_link</parent>"
                  "<child>trunk</child><axis><xyz>0 0 -1");
  const mjcf::Robot made = read(text);
  const int yaw = find(made, "left_yaw_link");
  ASSERT_EQ(made.bodies.size(), plain.bodies.size());
  const int below =
      made.bodies[static_cast<std::size_t>(yaw)].parent < 0 ? find(made, "trunk") : yaw;
  const double sign = below == yaw ? 1 : -1;
  EXPECT_NEAR(sign * made.bodies[static_cast<std::size_t>(below)].joints[0].axis.z(), 1, 1e-9);
}

TEST_F(SdfFile, MeshesAreFoundByModelFolderAndPath) {
  const std::string solid = "solid x\nendsolid x\n";
  const std::string absolute = write(solid, "meshes/a.stl");
  for (const std::string& uri :
       {std::string("model://theirs/meshes/a.stl"), std::string("model://other_name/meshes/a.stl"),
        std::string("meshes/a.stl"), absolute, "file://" + absolute}) {
    const mjcf::Robot made =
        read(robot("", "<visual name=\"v\"><geometry><mesh><uri>" + uri +
                           "</uri><scale>1 1 -1</scale></mesh></geometry></visual>"));
    EXPECT_EQ(lost(made, "not there"), "") << uri;
    ASSERT_EQ(made.meshes.size(), 1U);
    EXPECT_TRUE(fs::equivalent(made.meshes.begin()->second.file, absolute)) << uri;
    EXPECT_EQ(made.meshes.begin()->second.scale.z(), -1);
  }
}

TEST_F(SdfFile, AMimicFollowsItsJoint) {
  const mjcf::Robot made = read(replaced(
      robot(), "<child>right_knee_link</child><axis>",
      "<child>right_knee_link</child><axis><mimic joint=\"left_knee\"><multiplier>2</multiplier>"
      "<offset>0.3</offset><reference>0.1</reference></mimic>"));
  ASSERT_EQ(made.followers.size(), 1U);
  EXPECT_EQ(made.followers[0].second, "left_knee");
  EXPECT_NEAR(made.followers[0].offset, 0.1, 1e-12);
  EXPECT_EQ(made.followers[0].factor, 2);
}

TEST_F(SdfFile, MalformedFilesAreRefusedAtTheirLine) {
  struct Case {
    const char *from, *to, *refusal;
  };
  const auto with = [&](const Case& each) {
    return refusal(replaced("<?xml version=\"1.0\"?>\n" + robot(), each.from, each.to));
  };
  for (const Case& each : std::vector<Case>{
           {"<mass>1.2", "<mass>1,2", "3: <mass> is not a finite number: '1,2'"},
           {"<mass>1.2", "<mass>", "3: <mass> is not a finite number: ''"},
           {"0 0 0.4 0 0 0", "0 0 0.4", "3: <pose> is not six numbers: '0 0 0.4'"},
           {"<pose>0 0 0.4", "<pose relative_to=\"moon\">0 0 0.4",
            "3: there is no link, joint, frame or model 'moon'"},
           {"<pose>0 0 0.4", "<pose relative_to=\"trunk\">0 0 0.4",
            "3: the pose of 'trunk' is given in itself"},
           {"<parent>trunk<", "<parent>tronk<",
            "5: there is no link, joint, frame or model 'tronk'"},
           {"<parent>trunk<", "<parent>left_yaw_link<",
            "5: joint 'left_yaw' holds link 'left_yaw_link' to itself"},
           {"<parent>trunk</parent>", "", "5: joint 'left_yaw' has no <parent>"},
           {"type=\"revolute\"", "type=\"hinge\"", "5: there is no joint type 'hinge'"},
           {"<xyz>0 0 1", "<xyz>0 0 0", "5: the axis is zero"},
           {"<xyz>0 0 1", "<xyz>0 0", "5: <xyz> is not 3 finite numbers: '0 0'"},
           {"<lower>-1.6", "<lower>low", "5: <lower> is not a number: 'low'"},
           {"link name=\"left_yaw_link\"", "link name=\"trunk\"",
            "4: a second link, joint or frame is named 'trunk'"},
           {"joint name=\"left_roll\"", "joint name=\"left_yaw\"",
            "7: a second joint is named 'left_yaw'"},
           {"link name=\"trunk\"", "link", "3: <link> lacks the attribute 'name'"},
           {"<pose>0 0 0.4 0 0 0", "<pose rotation_format=\"quat_xyzw\">0 0 0.4 0 0 0 0",
            "3: its quaternion is zero"},
           {"<box><size>0.08 0.12 0.1", "<mesh><uri/></mesh><box><size>0.08 0.12 0.1",
            "3: a <mesh> has no <uri>"},
           {"<link name=\"trunk\">", "<verp:limb name=\"left_leg\"/><link name=\"trunk\">",
            "3: this is a robot of VERP already"}}) {
    EXPECT_EQ(with(each), each.refusal) << each.to;
  }
  EXPECT_EQ(refusal("<sdf version=\"1.9\"/>"), "1: there is no <model> in it");
  EXPECT_EQ(refusal("<sdf version=\"1.9\">\n<model name=\"x\"/></sdf>"),
            "2: there is no <link> in it");
  EXPECT_EQ(refusal("<sdf version=\"1.9\"><model name=\"x\">\n"),
            "2: malformed XML (the file ends, and <model> of line 1 is open)");
}

TEST_F(SdfFile, IncludesWithoutAnEndAreRefused) {
  EXPECT_NE(refusal(robot("<include><uri>robot.sdf</uri></include>")), "");
}

}  // namespace
}  // namespace verp::plain_sdf
