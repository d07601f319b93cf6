#include "host/study/identify/write.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/study/identify/numbers.hpp"

// Only the found numbers' lines differ.

namespace verp::identify {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

Result found(const model::Entity& entity, double armature_kg_m2) {
  Result result;
  result.type = types_of(entity).front();
  result.servo = *servo_of(entity, result.type);
  result.servo.gearbox.armature_kg_m2 = armature_kg_m2;
  result.servo.backlash_rad = 0.006;
  result.servo.goal_delay_s = 0.003;
  return result;
}

TEST(Write, ChangesTheServosAndNothingElse) {
  const fs::path folder = fs::temp_directory_path() / ("verp-identify-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const fs::path robot = model::find_model("generic21"), first = folder / "a.sdf",
                 second = folder / "b.sdf";
  EXPECT_EQ(write(found(model::load_robot(robot), 0.011), robot, first, "a.mcap"),
            "xm430_w210_identified");
  const std::vector<std::string> before = lines_of(robot), after = lines_of(first);
  ASSERT_EQ(after.size(), before.size() + 1);
  std::size_t b = 0, servos = 0;
  for (const std::string& line : after) {
    if (line.find("<verp:servo_type ") != line.npos) continue;
    if (line != before[b]) {
      EXPECT_NE(line.find("<verp:servo "), line.npos) << line;
      ++servos;
    }
    ++b;
  }
  EXPECT_EQ(servos, 21u);
  EXPECT_EQ(write(found(model::load_robot(first), 0.012), first, second, "b.mcap"),
            "xm430_w210_identified");
  const model::Entity entity = model::load_robot(second);
  EXPECT_EQ(lines_of(second).size(), after.size());
  for (const model::Joint& joint : entity.joints) {
    EXPECT_DOUBLE_EQ(joint.servo.gearbox.armature_kg_m2, 0.012) << joint.name;
    EXPECT_DOUBLE_EQ(joint.servo.backlash_rad, 0.006) << joint.name;
    EXPECT_DOUBLE_EQ(joint.servo.goal_delay_s, 0.003) << joint.name;
    EXPECT_EQ(joint.servo.source, "b.mcap");
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace verp::identify
