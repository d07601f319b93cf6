#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/hil/campaign_table.hpp"
#include "tests/hil/can_promises.hpp"

// To run one seed:
//
//     VERP_SEED=7 build/host-release/tests/hil/hil_can_campaign --gtest_filter='*lost_1_percent*'
namespace verp::test {
namespace {

const Robot& robot() {
  static const Robot loaded = load_robot("generic21", "can");
  return loaded;
}

struct Kind {
  CanPlan plan;
  std::vector<std::function<void(const CanFaultResult&)>> promises;
  bool as_far = false;  ///< as without the fault
  bool floods = false;  ///< the controller's own SYNCs wait
};

constexpr double kPercent = 1e-2;
constexpr CanFaults kAll{.lost = 0.1 * kPercent,
                         .missed = 0.05 * kPercent,
                         .doubled = 0.5 * kPercent,
                         .heard_twice = 0.05 * kPercent,
                         .overtaken = 0.5 * kPercent,
                         .late = 0.5 * kPercent,
                         .late_us = 12'000};
using Event = CanEvent;
using Says = Intruder::Kind;

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {{"lost_0_1_percent_physics", 2, {.lost = 0.1 * kPercent}, Event::kNone, {}, 0, 3, true},
       {lost_few},
       true},
      {{"lost_0_1_percent", 36, {.lost = 0.1 * kPercent}}, {lost_few}},
      {{"lost_1_percent", 12, {.lost = kPercent}}, {lost_many}},
      {{"missed_by_one", 10, {.missed = 0.02 * kPercent}}, {missed}},
      {{"doubled", 20, {.doubled = kPercent}}, {doubled}},
      {{"doubled_for_one", 8, {.heard_twice = 0.02 * kPercent}}, {doubled}},
      {{"reordered", 9, {.overtaken = kPercent}}, {overtaken}},
      {{"delayed", 7, {.late = kPercent, .late_us = 15'000}}, {delayed}},
      {{"all_held_back", 4, {.held_us = 12'000}, Event::kNone, {}, 0.2, 6},
       {held_back, walks_again}},
      {{"all_held_back_a_period", 3, {.held_us = 10'000}, Event::kNone, {}, 0.2, 6},
       {held_back, walks_again}},
      {{"everything", 7, kAll}, {everything}},
      {{.name = "error_frames", .runs = 8, .line = {.broken = 0.5 * kPercent}, .chip = true},
       {errors}},
      {{.name = "bus_off",
        .runs = 6,
        .event = Event::kBusOff,
        .lasts_s = 0.1,
        .walks_s = 1,
        .chip = true},
       {bus_off}},
      {{.name = "bus_offs_0_3_s",
        .runs = 4,
        .event = Event::kBusOffs,
        .lasts_s = 0.3,
        .walks_s = 4,
        .chip = true},
       {bus_offs, walks_again}},
      {{.name = "short_circuit_0_2_s",
        .runs = 3,
        .event = Event::kShort,
        .lasts_s = 0.2,
        .walks_s = 4,
        .chip = true},
       {cut, walks_again}},
      {{"node_silent_0_1_s", 7, {}, Event::kNodeSilent, {}, 0.1, 4}, {gone_briefly, walks_again}},
      {{"node_silent_0_1_s_physics", 2, {}, Event::kNodeSilent, {}, 0.1, 3, true}, {gone_briefly}},
      {{"node_silent_for_good", 7, {}, Event::kNodeSilent, {}, 0, 4}, {gone_for_good}},
      {{"node_silent_for_good_physics", 2, {}, Event::kNodeSilent, {}, 0, 3, true},
       {gone_for_good}},
      {{"node_flutters", 3, {}, Event::kFlutters, {}, 6, 10}, {flutters, walks_again}},
      {{"node_unpowered_0_1_s", 4, {}, Event::kNodeUnpowered, {}, 0.1, 8},
       {gone_briefly, let_go, walks_again}},
      {{"node_reboots", 10, {}, Event::kNodeReboots, {}, 0.5, 8}, {reboots, walks_again}},
      {{"nodes_reboot_for_1_s", 4, {}, Event::kManyReboot, {}, 1, 10}, {many_reboot, walks_again}},
      {{"all_reboot", 3, {}, Event::kAllReboot, {}, 2, 16}, {all_reboot, walks_again}},
      {{"imu_reboots", 6, {}, Event::kImuReboots, {}, 0.1, 4}, {imu_reboots, walks_again}},
      {{"foot_reboots", 2, {}, Event::kFootReboots, {}, 0.1}, {foot_reboots}},
      {{"intruder_urgent", 6, {}, Event::kNone, Says::kUrgent}, {urgent}},
      {{"intruder_crowds_1_s", 20, {}, Event::kNone, Says::kCrowd, 1, 6},
       {crowd, walks_again},
       false,
       true},
      {{"intruder_floods_0_3_s", 4, {}, Event::kNone, Says::kFlood, 0.3, 6},
       {flood, walks_again},
       false,
       true},
      {{"intruder_with_our_ids", 6, {}, Event::kNone, Says::kForeign}, {foreign}},
      {{"intruder_is_a_drive", 4, {}, Event::kNone, Says::kTwin, 1, 8}, {twin, walks_again}},
      {{"intruder_answers_unasked", 6, {}, Event::kNone, Says::kSdo}, {unasked}},
      {{"intruder_syncs", 8, {}, Event::kNone, Says::kSync, 1, 6}, {foreign_sync, walks_again}},
      {{"interface_down_0_2_s", 5, {.down = true}, Event::kNone, {}, 0.2, 4}, {down, walks_again}},
      {{"interface_down_1_s", 4, {.down = true}, Event::kNone, {}, 1, 8}, {down, walks_again}},
      {{"interface_down_0_2_s_physics", 2, {.down = true}, Event::kNone, {}, 0.2, 3, true}, {down}},
      {{"stale_values", 3, {}, Event::kRepeats, {}, 1}, {repeats}},
      {{"late_loop", 4, {}, Event::kLateLoop}, {late}},
      {{"controller_reset", 4, {}, Event::kReset, {}, 0, 6}, {reset, walks_again}},
      {{"hot_drive", 2, {}, Event::kHot, {}, 5, 9}, {hot, walks_again}},
      {{"overheated_drive", 2, {}, Event::kOverheated, {}, 0, 4}, {overheated}},
      {{"low_voltage", 2, {}, Event::kLowVoltage, {}, 5, 9}, {low_voltage, walks_again}},
      {{"supply_sags_under_load", 2, {}, Event::kSags, {}, 10, 14}, {sags, walks_again}},
      {{"joint_beyond_its_limits", 2, {}, Event::kJointBeyond, {}, 2, 6},
       {joint_beyond, walks_again}},
      {{"imu_gone_1_s", 3, {}, Event::kImuGone, {}, 1, 8}, {imu_gone, walks_again}},
      {{"imu_repeats_1_s", 2, {}, Event::kImuRepeats, {}, 1, 8}, {imu_repeats, walks_again}},
  };
  return all;
}

void keeps_what_all_promise(const Kind& kind, const CanFaultResult& result) {
  ASSERT_TRUE(result.ready) << result.violation;
  EXPECT_EQ(result.violation, "");
  EXPECT_GT(result.faults(), 0u) << "nothing was done to it";
  EXPECT_EQ(result.before.counted() + result.before.refused + result.before.missed_reports(), 0u)
      << "all was well before";
  EXPECT_GT(result.ticks_recorded, 0u) << "nothing was replayed";
  // In a flood, earlier SYNCs go first.
  const std::uint32_t period_us = robot().params.period_us;
  EXPECT_LT(result.worst_tick_us, kind.floods ? period_us * 3 / 2 : period_us)
      << "it waited for longer than a tick";
  EXPECT_EQ(result.bus.overruns, 0u) << "in a flood, too, it reads what comes";
  if (kind.plan.event == Event::kLateLoop) return;
  EXPECT_EQ(result.after.misses, 0u) << "no cable may cost the loop its time";
}

double clean_distance_m(const Kind& kind, std::uint32_t seed) {
  CanPlan clean = kind.plan;
  clean.line = {};
  const double walked_m = run_can_fault(robot(), clean, seed).distance_m;
  EXPECT_GT(walked_m, 0.4) << "the bar is a walk";
  return walked_m;
}

CampaignRun run_seed(const Kind& kind, std::uint32_t seed) {
  const CanFaultResult result = run_can_fault(robot(), kind.plan, seed);
  keeps_what_all_promise(kind, result);
  for (const auto& promise : kind.promises) promise(result);
  if (seed == 1) {
    EXPECT_EQ(run_can_fault(robot(), kind.plan, 1).digest, result.digest) << "the same seed";
  }
  return {.injected = result.faults(),
          .counted = result.after.counted() + result.after.refused + result.after.missed_reports() +
                     (result.after.reset_cause > 1 ? 1 : 0),
          .end = result.after.mode,
          .walked_m = kind.as_far ? result.distance_m : 0,
          .clean_m = kind.as_far ? clean_distance_m(kind, seed) : 0};
}

void run_kind(const Kind& kind, int runs) {
  run_seeds(kind.plan.name, runs, [&](std::uint32_t seed) { return run_seed(kind, seed); });
}

class CanCampaign : public ::testing::TestWithParam<std::size_t> {};

TEST_P(CanCampaign, StaysSafeAndTells) {
  const Kind& kind = kinds()[GetParam()];
  run_kind(kind, wanted_runs(kind.plan.runs));
}

INSTANTIATE_TEST_SUITE_P(Can, CanCampaign, ::testing::Range<std::size_t>(0, kinds().size()),
                         [](const auto& kind) {
                           return std::string(kinds()[kind.param].plan.name);
                         });

TEST(CanCampaignSize, Is200RunsOrMore) {
  int runs = 0;
  for (const Kind& kind : kinds()) runs += kind.plan.runs;
  EXPECT_GE(runs, 200);
}

TEST(CanCampaignSample, StaysSafeAndTells) {
  for (const Kind& kind : kinds()) {
    if (!kind.plan.physics) run_kind(kind, 1);
  }
}

}  // namespace
}  // namespace verp::test
