#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/hil/campaign_table.hpp"
#include "tests/hil/fault_run.hpp"
#include "tests/hil/promises.hpp"

// To run one seed:
//
//     VERP_SEED=7 build/host-release/tests/hil/hil_campaign --gtest_filter='*lost_0_1_percent*'
//
// VERP_RUNS=n takes the first n seeds of each kind.
namespace verp::test {
namespace {

using dxl::controller::DeviceState;

constexpr int kBus = dxl::controller::kDeviceBus;

const Robot& robot() {
  static const Robot loaded = load_robot("generic21");
  return loaded;
}

/// Each spoilt read shows as a timeout or as a device's missed report.
void shows_each_spoilt_read(const FaultResult& result) {
  EXPECT_GT(result.damage.spoilt_reads, 0u);
  EXPECT_GE(result.after.timeouts + result.after.missed_reports(), result.damage.spoilt_reads);
}

void lost_few(const FaultResult& result) {
  shows_each_spoilt_read(result);
  EXPECT_GT(result.after.crc_errors, 0u);
  keeps_walking(result);
}

void lost_many(const FaultResult& result) {
  shows_each_spoilt_read(result);
  EXPECT_GT(result.after.crc_errors, 0u);
  EXPECT_TRUE(was(result, kHolding)) << "servos are silent for longer than stale_hold_s";
}

void flipped(const FaultResult& result) {
  shows_each_spoilt_read(result);
  EXPECT_GT(result.after.crc_errors, 0u);
  keeps_walking(result);
}

// A header's doubled first byte does no harm.
void doubled(const FaultResult& result) {
  EXPECT_GT(result.after.crc_errors, 0u);
  EXPECT_GT(result.after.noise, 0u);
  EXPECT_GT(result.after.timeouts + result.after.missed_reports(), 0u);
  keeps_walking(result);
}

void delayed(const FaultResult& result) {
  EXPECT_GE(result.after.timeouts, result.damage.delayed / 2) << "some are late by too little";
  EXPECT_GT(result.after.strays, 0u) << "what comes too late belongs to nobody";
  EXPECT_EQ(was(result, kHolding), result.stale) << "late replies are silence, and as long";
  if (!result.stale) keeps_walking(result);
}

// All comes a period late, so nothing counts as fresh.
void held_back(const FaultResult& result) {
  EXPECT_EQ(result.during.fresh, 0u);
  EXPECT_NE(result.during.state[kBus], DeviceState::kGood);
  EXPECT_GT(result.after.timeouts, 0u);
  EXPECT_GT(result.after.strays, 0u);
  EXPECT_TRUE(was(result, kHolding));
}

void noise(const FaultResult& result) {
  EXPECT_GE(result.after.noise, result.damage.noise_heard * 9 / 10);
  EXPECT_GT(result.after.crc_errors + result.after.timeouts, 0u);
  keeps_walking(result);
}

void cut_all(const FaultResult& result) {
  EXPECT_GE(result.during.timeouts, result.damage.spoilt_reads);
  cut(result);
}

void everything(const FaultResult& result) {
  EXPECT_GT(result.after.crc_errors, 0u);
  EXPECT_GT(result.after.timeouts, 0u);
  EXPECT_GT(result.after.noise, 0u);
  EXPECT_GT(result.after.missed_reports(), 0u);
}

struct Kind {
  FaultPlan plan;
  std::vector<std::function<void(const FaultResult&)>> promises;
  bool as_far = false;  ///< as without the fault
};

constexpr double kPerMille = 1e-3;
constexpr LineFaults kAll{.lost = kPerMille / 2,
                          .doubled = kPerMille / 2,
                          .flipped = kPerMille / 2,
                          .delayed = 0.02,
                          .delay_us = 12'000,
                          .bursts = 0.02};

// On its stand the robot cannot fall. With physics it may fall where no other promise holds, and
// must then be limp.
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {{"lost_0_1_percent_physics", 8, true, {.lost = kPerMille}}, {lost_few}, true},
      {{"lost_0_1_percent", 11, false, {.lost = kPerMille}}, {lost_few}},
      {{"lost_1_percent_physics", 4, true, {.lost = 10 * kPerMille}}, {lost_many}},
      {{"lost_1_percent", 12, false, {.lost = 10 * kPerMille}}, {lost_many}},
      {{"doubled", 13, false, {.doubled = kPerMille}}, {doubled}},
      {{"flipped", 13, false, {.flipped = kPerMille}}, {flipped}},
      {{"delayed", 12, false, {.delayed = 0.05, .delay_us = 15'000}}, {delayed}},
      {{"all_held_back", 4, false, {.held_us = 12'000}, Event::kNone, 0.2, 8},
       {held_back, walks_again}},
      {{"noise", 13, false, {.bursts = 0.05}}, {noise}},
      {{"everything", 12, false, kAll}, {everything}},
      {{"servo_gone_0_1_s_physics", 4, true, {}, Event::kServoGone, 0.1}, {gone_briefly}},
      {{"servo_gone_0_1_s", 8, false, {}, Event::kServoGone, 0.1}, {gone_briefly, walks_again}},
      {{"servo_unpowered_0_1_s", 6, false, {}, Event::kServoUnpowered, 0.1, 8},
       {gone_briefly, let_go, walks_again}},
      {{"servo_gone_for_good_physics", 3, true, {}, Event::kServoGone}, {gone_for_good}},
      {{"servo_gone_for_good", 13, false, {}, Event::kServoGone}, {gone_for_good}},
      {{"servo_flutters", 3, false, {}, Event::kFlutters, 6, 10}, {flutters, walks_again}},
      {{"stale_values", 12, false, {}, Event::kRepeats, 1}, {repeats}},
      {{"late_loop", 6, false, {}, Event::kLateLoop}, {late}},
      {{"cut_0_2_s_physics", 3, true, {.cut = true}, Event::kNone, 0.2}, {cut_all}},
      {{"cut_1_s", 9, false, {.cut = true}, Event::kNone, 1, 8}, {cut_all, walks_again}},
      {{"controller_reset_physics", 3, true, {}, Event::kReset}, {reset}},
      {{"controller_reset", 7, false, {}, Event::kReset, 0, 6}, {reset, walks_again}},
      {{"hot_servo", 3, false, {}, Event::kHot, 5, 9}, {hot, walks_again}},
      {{"overheated_servo", 3, false, {}, Event::kOverheated, 0, 4}, {overheated}},
      {{"low_voltage", 3, false, {}, Event::kLowVoltage, 5, 9}, {low_voltage, walks_again}},
      {{"supply_sags_under_load", 3, false, {}, Event::kSags, 10, 14}, {sags, walks_again}},
      {{"joint_beyond_its_limits", 3, false, {}, Event::kJointBeyond, 2, 6},
       {joint_beyond, walks_again}},
      {{"imu_gone_1_s", 3, false, {}, Event::kImuGone, 1, 8}, {imu_gone, walks_again}},
      {{"imu_repeats_1_s", 3, false, {}, Event::kImuRepeats, 1, 8}, {imu_repeats, walks_again}},
  };
  return all;
}

void keeps_what_all_promise(const Kind& kind, const FaultResult& result) {
  ASSERT_TRUE(result.ready) << result.violation;
  EXPECT_EQ(result.violation, "");
  EXPECT_GT(result.damage.faults() + result.events, 0u) << "nothing was done to it";
  EXPECT_EQ(result.before.counted() + result.before.missed_reports(), 0u) << "all was well before";
  EXPECT_LT(result.worst_tick_us, robot().params.period_us) << "it waited for longer than a tick";
  if (kind.plan.event == Event::kLateLoop) return;
  EXPECT_EQ(result.after.misses, 0u) << "no cable may cost the loop its time";
}

double clean_distance_m(const Kind& kind, std::uint32_t seed) {
  FaultPlan clean = kind.plan;
  clean.line = {};
  const double walked_m = run_fault(robot(), clean, seed).distance_m;
  EXPECT_GT(walked_m, 0.4) << "the bar is a walk";
  return walked_m;
}

CampaignRun run_seed(const Kind& kind, std::uint32_t seed) {
  const FaultResult result = run_fault(robot(), kind.plan, seed);
  keeps_what_all_promise(kind, result);
  for (const auto& promise : kind.promises) promise(result);
  return {.injected = result.damage.faults() + result.events,
          .counted = result.after.counted() + result.after.missed_reports() +
                     (result.after.reset_cause > 1 ? 1 : 0),
          .end = result.after.mode,
          .walked_m = kind.as_far ? result.distance_m : 0,
          .clean_m = kind.as_far ? clean_distance_m(kind, seed) : 0};
}

void run_kind(const Kind& kind, int runs) {
  run_seeds(kind.plan.name, runs, [&](std::uint32_t seed) { return run_seed(kind, seed); });
}

class Campaign : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Campaign, StaysSafeAndTells) {
  const Kind& kind = kinds()[GetParam()];
  run_kind(kind, wanted_runs(kind.plan.runs));
}

INSTANTIATE_TEST_SUITE_P(Serial, Campaign, ::testing::Range<std::size_t>(0, kinds().size()),
                         [](const auto& kind) {
                           return std::string(kinds()[kind.param].plan.name);
                         });

TEST(CampaignSize, Is200Runs) {
  int runs = 0;
  for (const Kind& kind : kinds()) runs += kind.plan.runs;
  EXPECT_EQ(runs, 200);
}

TEST(CampaignSample, StaysSafeAndTells) {
  for (Kind kind : kinds()) {
    if (kind.plan.physics) continue;
    run_kind(kind, 2);
  }
}

}  // namespace
}  // namespace verp::test
