#include <gtest/gtest.h>

#include "host/author/edit/change.hpp"
#include "host/author/edit/parts.hpp"
#include "host/robot/model/load.hpp"
#include "tests/host/edit/files.hpp"

namespace verp::edit {
namespace {

TEST(Biped, GrowsFromAnEmptyFileAndIsSound) {
  const files::TemporaryDirectory folder;
  const std::string file = (folder.path() / "biped.sdf").string();
  write(file, "");
  Document document = Document::open(file);
  const auto add_part = [&](const std::string& kind, const Words& words) {
    document.apply(add(document, kind, words));
    const auto complaint = check(document);
    EXPECT_TRUE(!complaint || complaint->unfinished) << complaint->line_of_text();
  };
  add_part("link",
           {{"name", "trunk"}, {"mass", "1.1"}, {"size", "0.08,0.12,0.1"}, {"centre", "0,0,0.05"}});
  add_part("body", {{"link", "trunk"}});
  add_part("bus", {{"protocol", "dynamixel2"}});
  struct Row {
    const char *name, *parent, *at, *axis, *lower, *upper, *mass, *size, *centre;
  };
  const Row rows[] = {
      {"l_hip_yaw", "trunk", "0,0.0375,-0.02", "z", "-1", "1", "0.05", "0.03,0.03,0.02", "0,0,0"},
      {"l_hip_roll", "l_hip_yaw_link", "0,0,0", "x", "-0.6", "0.8", "0.12", "0.04,0.036,0.03",
       "0,0,0"},
      {"l_hip_pitch", "l_hip_roll_link", "0,0,0", "y", "-1.9", "0.7", "0.12", "0.04,0.04,0.07",
       "0,0,-0.05"},
      {"l_knee", "l_hip_pitch_link", "0,0,-0.093", "y", "0", "2.3", "0.06", "0.04,0.04,0.07",
       "0,0,-0.045"},
      {"l_ankle_pitch", "l_knee_link", "0,0,-0.093", "y", "-1.3", "1", "0.12", "0.04,0.036,0.03",
       "0,0,0"},
      {"l_ankle_roll", "l_ankle_pitch_link", "0,0,0", "x", "-0.8", "0.6", "0.08",
       "0.104,0.066,0.01", "0,0,-0.0285"}};
  int id = 0;
  for (const Row& row : rows) {
    add_part("joint", {{"name", row.name},
                       {"parent", row.parent},
                       {"at", row.at},
                       {"axis", row.axis},
                       {"lower", row.lower},
                       {"upper", row.upper},
                       {"mass", row.mass},
                       {"size", row.size},
                       {"centre", row.centre}});
    add_part("servo", {{"joint", row.name}, {"id", std::to_string(++id)}, {"type", "xm430_w210"}});
  }
  add_part("frame", {{"name", "left_sole"}, {"on", "l_ankle_roll_link"}, {"at", "0,0,-0.0335"}});
  add_part("limb", {{"name", "left_leg"}, {"base", "trunk"}, {"tip", "left_sole"}});
  document.apply(mirror(document, document.find("joint:l_hip_yaw")));
  add_part("imu", {{"link", "trunk"}, {"id", "120"}, {"type", "icm20648"}});
  const auto complaint = check(document);
  ASSERT_FALSE(complaint) << complaint->line_of_text();
  document.save();
  const model::Entity entity = model::load_robot(file);
  EXPECT_EQ(entity.joints.size(), 12U);
  EXPECT_EQ(entity.limbs.size(), 2U);
}

TEST(Biped, WhatIsMissingOrUnknownIsToldAndNothingChanges) {
  Document document("a.sdf", "<sdf version=\"1.9\"><model name=\"a\"/></sdf>");
  const auto refused = [&](const std::string& kind, const Words& words) {
    EXPECT_THROW(add(document, kind, words), model::LoadError) << kind;
  };
  refused("wing", {});
  refused("link", {{"name", "a"}});
  refused("link", {{"name", "a"}, {"mass", "0"}, {"size", "1,1,1"}});
  refused("link", {{"name", "a"}, {"mass", "1"}, {"size", "1,1"}});
  refused("link", {{"name", "a"}, {"mass", "1"}, {"size", "1,1,1"}, {"colour", "red"}});
  refused("joint",
          {{"name", "a"}, {"parent", "b"}, {"axis", "up"}, {"lower", "0"}, {"upper", "1"}});
  refused("servo", {{"joint", "a"}, {"id", "1"}, {"type", "xm430_w210"}});
  refused("sensor", {{"name", "imu"}, {"link", "nothing"}, {"type", "imu"}});
}

}  // namespace
}  // namespace verp::edit
