#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "tests/scenario/walk.hpp"

namespace verp::scenario {
namespace {

/// generic21 with these joints of both legs fixed.
std::string generic21_without(const std::string& name, const std::vector<std::string>& joints) {
  std::ifstream file(VERP_SOURCE_DIR "/common/robots/generic21/robot.sdf");
  std::string text(std::istreambuf_iterator<char>(file), {});
  std::string fixed;
  for (const std::string& joint : joints) {
    text =
        std::regex_replace(text, std::regex("<verp:servo joint=\"[lr]_" + joint + "\"[^>]*/>"), "");
    for (const char* side : {"l_", "r_"})
      fixed += "<verp:fix joint=\"" + (side + joint) + "\" reason=\"a test\"/>";
  }
  text.insert(text.find("<verp:body"), fixed);
  const auto folder = std::filesystem::path(testing::TempDir()) / name;
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "robot.sdf") << text;
  return (folder / "robot.sdf").string();
}

Walk walk_of(const std::string& robot, const std::string& more = "") {
  const Walk result =
      walk(robot + " --for 12 --velocity 0.05,0,0 --physics-step 2 --set gait.zmp_y_m=" + more);
  expect_walked(result);
  EXPECT_EQ(result.result.value("notes", "").find("out of reach"), std::string::npos);
  return result;
}

TEST(FewJoints, WithoutAnkleRollItWalksAhead) {
  const Walk result = walk_of(generic21_without("noroll", {"ankle_roll"}), "-0.029");
  expect_between(0.45, number(result, "ahead_m"), 1.2, "way ahead, m");
  expect_between(-0.3, number(result, "lateral_drift_m"), 0.3, "drift, m");
}

TEST(FewJoints, WithoutHipYawItWalksStraight) {
  const Walk result = walk_of(generic21_without("noyaw", {"hip_yaw"}), "0.0022");
  expect_between(0.45, number(result, "ahead_m"), 0.8, "way ahead, m");
  expect_between(-15, number(result, "yaw_drift_deg"), 15, "turn, degrees");
}

TEST(FewJoints, WithoutBothItWalks) {
  const Walk result = walk_of(generic21_without("four", {"hip_yaw", "ankle_roll"}), "-0.029");
  expect_between(0.45, number(result, "ahead_m"), 1.5, "way ahead, m");
}

}  // namespace
}  // namespace verp::scenario
