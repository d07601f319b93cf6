#include <gtest/gtest.h>

#include <filesystem>

#include "host/os/files/temporary_directory.hpp"
#include "host/show/scene/from_trace.hpp"
#include "host/show/scene/from_twin.hpp"
#include "host/show/web/replay_page.hpp"
#include "host/trace/record/trace_writer.hpp"
#include "tests/host/session/plans.hpp"

namespace verp::scene {
namespace {

using session::test::Chain;
using session::test::plan_of;

struct Watched {
  Chain chain;
  std::vector<Snapshot> shots;
  std::vector<sim::Truth> truths;
};

Watched walk_watched(const session::WalkPlan& plan, record::TraceWriter* trace, bool watched) {
  Watched out;
  session::Hooks hooks;
  hooks.trace = trace;
  hooks.ticked = [&](const session::Tick& tick) {
    out.chain.push_back(tick.record->digest.chain);
    if (!watched) return;
    out.shots.push_back(snapshot(tick, plan.entity, plan.params));
    out.truths.push_back(tick.seen.truth);
  };
  EXPECT_EQ(session::walk(plan, hooks).failure, "");
  return out;
}

TEST(Snapshot, OfTheTwinIsTheTruthOfItsTickAndTheRunHasTheSameBitsUnwatched) {
  const session::WalkPlan plan = plan_of("dxl");
  const Watched seen = walk_watched(plan, nullptr, true);
  EXPECT_EQ(seen.chain, walk_watched(plan, nullptr, false).chain);
  ASSERT_GT(seen.shots.size(), 300u);
  bool walked = false;
  for (std::size_t i = 0; i < seen.shots.size(); ++i) {
    const RobotView& view = seen.shots[i].robots.front();
    const sim::Truth& truth = seen.truths[i];
    EXPECT_EQ(view.joint_rad, truth.joint_rad);
    EXPECT_LT((view.link_world[0].matrix() - truth.body_world.matrix()).norm(), 1e-12);
    const model::Limb& leg = *sim::find_leg(plan.entity, 0);
    const Transform sole =
        view.link_world[static_cast<std::size_t>(leg.joints.back() + 1)] * leg.tip;
    EXPECT_LT((sole.matrix() - truth.foot[0].sole_world.matrix()).norm(), 2e-3) << i;
    walked |= !view.footsteps.empty() && view.zmp_planned_world_m && view.zmp_world_m;
    EXPECT_EQ(view.goal_rad.size(), view.joint_rad.size());
  }
  EXPECT_TRUE(walked);
}

TEST(Snapshot, OfATraceIsWhereTheTwinWasAndPlansWhatItPlanned) {
  const session::WalkPlan plan = plan_of("dxl");
  const files::TemporaryDirectory folder;
  const std::filesystem::path file = folder.path() / "a.mcap";
  record::TraceWriter writer(file, plan.params, {{"model_file", plan.entity.file}});
  const Watched seen = walk_watched(plan, &writer, true);
  writer.close();
  const TracePlayer player(file);
  EXPECT_EQ(player.note(), "");
  ASSERT_EQ(player.size(), seen.shots.size());
  for (std::size_t i = 0; i < seen.shots.size(); i += 37) {
    const RobotView &there = seen.shots[i].robots.front(), here = player.at(i).robots.front();
    // The trace has 25 poses a second, angles in counts.
    EXPECT_LT((there.link_world[0].translation() - here.link_world[0].translation()).norm(), 2e-3)
        << i;
    EXPECT_EQ(there.phase, here.phase);
    EXPECT_EQ(there.gait_state, here.gait_state);
    EXPECT_EQ(there.goal_rad, here.goal_rad);
    ASSERT_EQ(there.footsteps.size(), here.footsteps.size());
    for (std::size_t s = 0; s < here.footsteps.size(); ++s) {
      EXPECT_LT((there.footsteps[s].at_world_m - here.footsteps[s].at_world_m).norm(), 8e-3) << i;
    }
  }
  const double middle_s = (player.begin_s() + player.end_s()) / 2;
  EXPECT_NEAR(player.at(player.index_at(middle_s)).t_s, middle_s, player.trace().period_s());
}

TEST(Snapshot, OfATraceWithoutATwinFollowsTheFeetAndOfAnUnknownRobotItsNumbers) {
  session::WalkPlan plan = plan_of("dxl");
  std::snprintf(plan.params.name, sizeof plan.params.name, "nobody");
  const files::TemporaryDirectory folder;
  const std::filesystem::path file = folder.path() / "b.mcap";
  record::TraceWriter writer(file, plan.params, {}, {.ros = false});
  const Watched seen = walk_watched(plan, &writer, true);
  writer.close();
  const TracePlayer player(file);
  EXPECT_NE(player.note().find("nobody"), std::string::npos);
  const auto ahead = [](const std::vector<Transform>& begin, const std::vector<Transform>& end) {
    return (end[0].translation() - begin[0].translation()).head<2>().norm();
  };
  const double truly_m =
      ahead(seen.shots.front().robots[0].link_world, seen.shots.back().robots[0].link_world);
  const double shown_m =
      ahead(player.at(0).robots[0].link_world, player.at(player.size() - 1).robots[0].link_world);
  EXPECT_GT(truly_m, 0.03);
  EXPECT_NEAR(shown_m, truly_m, 0.35 * truly_m + 0.02);
}

TEST(ReplayPage, HoldsAllThatItShowsAndAsksNobody) {
  const session::WalkPlan plan = plan_of("dxl");
  const files::TemporaryDirectory folder;
  const std::filesystem::path file = folder.path() / "a.mcap";
  record::TraceWriter writer(file, plan.params, {{"model_file", plan.entity.file}});
  walk_watched(plan, &writer, false);
  writer.close();
  const web::Replay replay = web::replay_of(file);
  if (replay.html.empty()) {
    EXPECT_NE(replay.note.find("apt-get install libjs-three"), std::string::npos);
    return;
  }
  const std::string page = web::page_of("a.mcap", replay.html);
  for (const char* word : {"<script src", "<link", "@import", "src=\"http"}) {
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  }
  EXPECT_NE(page.find("\"l_knee\""), std::string::npos);
  EXPECT_LT(page.size(), 1'500'000u);
  EXPECT_THROW(web::replay_of(folder.path() / "none.mcap"), record::TraceError);
}

}  // namespace
}  // namespace verp::scene
