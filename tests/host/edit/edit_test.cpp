#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "host/author/edit/change.hpp"
#include "host/author/edit/names.hpp"
#include "host/author/edit/parts.hpp"
#include "host/robot/model/load.hpp"
#include "tests/host/edit/files.hpp"

namespace verp::edit {
namespace {

TEST(Edit, ANumberChangesItsOwnBytesAndNoOthersAndIsTakenBack) {
  Document document = Document::open(robot("generic21"));
  const std::string before = document.text();
  const Edit edit = set(document, "link:trunk/inertial/mass", "1.25");
  document.apply(edit);
  EXPECT_EQ(document.text().size(), before.size() + 1);
  EXPECT_EQ(changed_lines(before, document.text()), kOneLine);
  EXPECT_FALSE(check(document));
  document.apply(edit.reversed());
  EXPECT_EQ(document.text(), before);
  EXPECT_FALSE(document.changed());
}

TEST(Edit, OfOtherPeoplesFilesOnlyTheEditedLinesChange) {
  for (const char* name : {"op3_urdf", "darwin_op_urdf"}) {
    Document document = Document::open(robot(name));
    const std::string before = document.text();
    const int servo = document.find("bus/servo:1");
    document.apply(set(document, document.path(servo) + "@id", "33"));
    EXPECT_EQ(changed_lines(before, document.text()), kOneLine) << name;
  }
  expect_a_mass_changes_one_line(VERP_SOURCE_DIR
                                 "/tests/host/model/published_robot/published.urdf");
}

TEST(Edit, CommentsBlanksQuotesAndLineEndsStayAsTheyWere) {
  const std::string text =
      "<sdf version='1.9'>\r\n<model   name = 'a'><!-- <link name=\"no\"/> -->\r\n"
      "\t<link name='b'  ><mass> 1.0 <!-- kg --></mass ></link>\r\n</model></sdf>";
  Document document("a.sdf", text);
  document.apply(set(document, "link:b/mass", "2"));
  std::string wanted = text;
  wanted.replace(wanted.find("1.0"), 3, "2");
  EXPECT_EQ(document.text(), wanted);
  document.apply(set(document, "link:b@name", "it's"));
  EXPECT_NE(document.text().find("name='it&apos;s'"), std::string::npos);
  EXPECT_EQ(document.attribute(document.find("link"), "name"), "it's");
}

TEST(Edit, DeletingALegAndMirroringTheOtherGivesTheSameRobot) {
  Document document = Document::open(robot("generic21"));
  const model::Entity before = model::load_robot(robot("generic21"));
  document.apply(remove(document, document.find("joint:r_hip_yaw")));
  ASSERT_TRUE(check(document));
  EXPECT_EQ(document.text().find("\"r_knee\""), std::string::npos) << "servos and poses go too";
  EXPECT_NE(document.text().find("\"r_elbow\""), std::string::npos);
  document.apply(mirror(document, document.find("joint:l_hip_yaw")));
  const auto complaint = check(document);
  ASSERT_FALSE(complaint) << complaint->line_of_text();
  const model::Entity after = model::load_robot_text(robot("generic21"), document.text());
  ASSERT_EQ(after.joints.size(), before.joints.size());
  for (std::size_t j = 0; j < before.joints.size(); ++j) {
    const auto& was = before.joints[j];
    const auto is = std::find_if(after.joints.begin(), after.joints.end(),
                                 [&](const auto& each) { return each.name == was.name; });
    ASSERT_NE(is, after.joints.end()) << was.name;
    const auto& node = after.nodes[std::size_t(is - after.joints.begin()) + 1];
    EXPECT_LT((is->origin_m - was.origin_m).norm(), 1e-9) << was.name;
    EXPECT_LT((is->axis - was.axis).norm(), 1e-9) << was.name;
    EXPECT_EQ(is->lower_rad, was.lower_rad) << was.name;
    EXPECT_EQ(is->upper_rad, was.upper_rad) << was.name;
    EXPECT_EQ(is->stand_rad, was.stand_rad) << was.name;
    EXPECT_EQ(is->servo.id, was.servo.id) << was.name;
    EXPECT_EQ(is->servo.direction, was.servo.direction) << was.name;
    EXPECT_EQ(node.mass_kg, before.nodes[j + 1].mass_kg) << was.name;
    EXPECT_LT((node.com_m - before.nodes[j + 1].com_m).norm(), 1e-9) << was.name;
  }
}

TEST(Edit, ARenamedPartIsRenamedWhereverItIsNamed) {
  Document document = Document::open(robot("generic21"));
  document.apply(rename(document, document.find("joint:l_knee"), "left_knee"));
  document.apply(rename(document, document.find("link:trunk"), "torso"));
  EXPECT_EQ(document.text().find("\"l_knee\""), std::string::npos);
  EXPECT_EQ(document.text().find(">trunk<"), std::string::npos);
  EXPECT_FALSE(check(document));
  EXPECT_THROW(rename(document, document.find("link:torso"), "l_foot"), model::LoadError);
}

TEST(Edit, ADuplicateHasNamesAndIdsOfItsOwn) {
  Document document = Document::open(robot("generic21"));
  document.apply(duplicate(document, document.find("joint:head_yaw"), "tail_yaw"));
  const auto complaint = check(document);
  ASSERT_TRUE(!complaint || complaint->unfinished) << complaint->line_of_text();
  EXPECT_TRUE(document.look_for("joint:tail_yaw"));
  EXPECT_TRUE(document.look_for("bus:dxl/servo:tail_yaw"));
  EXPECT_TRUE(is_taken(document, Kind::kLink, "neck_2"));
}

TEST(Edit, AComplaintNamesTheLineAndThePart) {
  Document document = Document::open(robot("generic21"));
  document.apply(set(document, "link:l_foot/inertial/mass", "-1"));
  const auto complaint = check(document);
  ASSERT_TRUE(complaint);
  EXPECT_FALSE(complaint->unfinished);
  EXPECT_EQ(complaint->part, "link:l_foot/inertial/mass");
  EXPECT_EQ(complaint->line, line_at(document.text(), document.text().find("<mass>-1")));
}

TEST(Edit, SidesAreFoundInNamesAsPeopleWriteThem) {
  for (const auto& [left, right] : {std::pair{"l_knee", "r_knee"},
                                    {"left_sole", "right_sole"},
                                    {"LeftFoot", "RightFoot"},
                                    {"knee_L", "knee_R"},
                                    {"arm.l", "arm.r"}}) {
    EXPECT_EQ(other_side(left), right);
    EXPECT_EQ(other_side(right), left);
  }
  EXPECT_EQ(other_side("trunk"), "");
  EXPECT_EQ(other_side("bright_cellar"), "");
}

TEST(Edit, BrokenTextIsToldWithItsLine) {
  for (const char* text : {"", "<sdf>", "<sdf>\n<a></b></sdf>", "<sdf a=1/>", "<sdf a='1", "<!--",
                           "<sdf/><sdf/>", "<a b='1' b='2'/>", "<", "</a>"}) {
    EXPECT_THROW(Document("a.sdf", text), model::LoadError) << text;
  }
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  EXPECT_THROW(Document("a.sdf", deep), model::LoadError);
}

}  // namespace
}  // namespace verp::edit
