#include "host/author/action/check.hpp"

#include <gtest/gtest.h>

#include "tests/host/action/robots.hpp"

namespace verp::action {
namespace {

using test::generic21;
using test::Robot;

ActionCheck checked(const std::string& text) {
  const CompiledActions made = generic21().make({text});
  return check(generic21().entity, generic21().params, made, 1);
}

void expect_bad(const std::string& text, int line, const std::string& what) {
  const ActionCheck result = checked(text);
  ASSERT_NE(result.first_bad(), nullptr) << what;
  EXPECT_EQ(result.first_bad()->line, line);
  EXPECT_NE(result.first_bad()->problem.find(what), std::string::npos)
      << result.first_bad()->problem;
}

TEST(ActionCheck, NamesTheFirstFrameThatIsTooFast) {
  expect_bad("action a\nframe 1\n head_yaw 10\nframe 0.1\n head_yaw 100\n", 4, "rad/s");
}

TEST(ActionCheck, NamesTheFrameInWhichLinksMeet) {
  expect_bad("action a\nframe 1\n r_shoulder_roll 10\n r_shoulder_pitch 0\n r_elbow 0\n", 2,
             "meet");
}

TEST(ActionCheck, NamesTheFrameInWhichTheWeightIsBesideTheSoles) {
  expect_bad("action a\nframe 1\n over right 0.7\nframe 0.5\n stance left\n right_foot z 0.02\n", 4,
             "ZMP");
}

TEST(ActionCheck, SaysThatItEndsBeforeAnActionOfHours) {
  const std::string once = "action a\nframe 1\n head_yaw 10\n";
  EXPECT_TRUE(checked(once).whole);
  const ActionCheck hours =
      checked("action a\nframe start 50\n head_yaw 10\nframe 50\n repeat 255 from start\n");
  EXPECT_FALSE(hours.whole);
  EXPECT_EQ(hours.first_bad(), nullptr);
}

TEST(ActionCheck, EveryShippedActionPasses) {
  for (const auto& [name, least] : {std::pair{"generic21", 6},
                                    {"op3", 6},
                                    {"darwin_op", 6},
                                    {"microduck", 4},
                                    {"open_duck", 4}}) {
    const Robot robot(name);
    const CompiledActions made =
        make_library(robot.params, read_folder(folder_of(robot.entity.file)));
    EXPECT_GE(made.library().count(), least) << name;
    for (int number = 1; number <= made.library().count(); ++number) {
      const ActionCheck result = check(robot.entity, robot.params, made, number);
      const FrameCheck* bad = result.first_bad();
      EXPECT_EQ(bad, nullptr) << name << " " << made.library().action(number).name << " line "
                              << bad->line << ": " << bad->problem;
    }
  }
}

}  // namespace
}  // namespace verp::action
