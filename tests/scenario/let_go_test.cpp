#include "host/author/action/let_go.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/study/tune/lie_down.hpp"
#include "host/twin/sim/vary.hpp"

namespace verp::action {
namespace {

class LettingGo : public testing::TestWithParam<const char*> {
 protected:
  const model::Entity entity_ = model::load_robot(model::find_model(GetParam()));
};

TEST_P(LettingGo, ComesAfterLyingDownAndMovesTheRobotNoMore) {
  const LetGo ends = let_go(entity_);
  EXPECT_TRUE(ends.good) << ends.words();
  EXPECT_TRUE(ends.by_action);
  EXPECT_EQ(ends.ends, "lies on its front");
  EXPECT_LT(ends.moved_rad, 0.2);
  EXPECT_LT(ends.fall_percent, 5);
}

TEST_P(LettingGo, IsAsGentleForRandomRobotsOnRandomFloors) {
  sim::WorldOptions world;
  world.step_us = 2000;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    sim::TwinOptions twin;
    twin.seed = seed;
    const sim::Varied varied = sim::vary(entity_, twin, world);
    session::WalkPlan plan;
    plan.entity = varied.entity;
    plan.params = model::make_params(entity_);
    plan.twin = varied.twin;
    const LetGo ends = let_go(std::move(plan), varied.world);
    EXPECT_TRUE(ends.good) << "seed " << seed << ": " << ends.words() << ", " << ends.fall_percent;
  }
}

TEST_P(LettingGo, ThrowsARobotDownThatCannotLieDown) {
  model::Entity bare = entity_;
  bare.file = "/nowhere/robot.sdf";
  const LetGo ends = let_go(bare);
  EXPECT_TRUE(ends.tried);
  EXPECT_FALSE(ends.good);
  EXPECT_FALSE(ends.by_action);
  EXPECT_GT(ends.moved_rad, 1.0);
  EXPECT_GT(ends.fell_s, 0.1);
  EXPECT_NE(ends.words("mine").find("verp action make lie_down mine"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Robots, LettingGo, testing::Values("generic21", "op3", "darwin_op"),
                         [](const auto& each) { return std::string(each.param); });

TEST(LettingGoOverCan, ComesAfterLyingDownToo) {
  const LetGo ends = let_go(model::load_robot(model::find_model("generic21"), "can"));
  EXPECT_TRUE(ends.good) << ends.words();
  EXPECT_EQ(ends.ends, "lies on its front");
}

TEST(LettingGoOfAnArm, IsNotTried) {
  model::Entity entity = model::load_robot(model::find_model("generic21"));
  entity.limbs.clear();
  EXPECT_FALSE(let_go(entity).tried);
}

namespace fs = std::filesystem;

const fs::path kOthers = VERP_SOURCE_DIR "/tests/host/model";
/// Without a search: the shipped robots' ways only.
constexpr tune::LieDownOptions kAsTheyAre = {.generations = 0, .judges = 3};

TEST(LettingGoOfAnImportedRobot, ComesAfterTheLieDownThatIsMadeForIt) {
  const model::Entity bare = model::load_robot(kOthers / "odd_robot/robot.sdf");
  const tune::LieDown made = tune::make_lie_down(bare, kAsTheyAre, {});
  ASSERT_TRUE(made.found) << made.worst.words();
  const fs::path folder = fs::temp_directory_path() / ("verp-let-go-" + std::to_string(::getpid()));
  fs::copy(kOthers / "odd_robot", folder);
  fs::create_directory(folder / "actions");
  std::ofstream(folder / "actions/lie_down.action") << text_of(made.document);
  const LetGo ends = let_go(model::load_robot(folder / "robot.sdf"));
  fs::remove_all(folder);
  EXPECT_TRUE(ends.good && ends.by_action) << ends.words();
  EXPECT_EQ(ends.ends, "lies on its front");
  EXPECT_LT(ends.moved_rad, 0.2);
  EXPECT_LT(ends.fall_percent, 8);
}

// Its wrapper gives the legs no shapes, so its knees carry nothing.
TEST(LettingGoOfAnImportedRobot, GetsNoLieDownThatTheTwinDidNotShow) {
  const model::Entity entity = model::load_robot(kOthers / "published_robot/robot.sdf");
  const tune::LieDown made = tune::make_lie_down(entity, kAsTheyAre, {});
  EXPECT_FALSE(made.found);
  EXPECT_GT(made.worst.fall_percent, 8);
}

}  // namespace
}  // namespace verp::action
