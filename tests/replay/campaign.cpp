#include "tests/replay/campaign.hpp"

#include <bit>
#include <cstddef>

#include "common/model/tuning_ranges.hpp"
#include "common/safety/machine.hpp"

namespace verp::replay {
namespace {

constexpr std::uint8_t until(safety::Mode mode) {
  return static_cast<std::uint8_t>(mode);
}
constexpr std::uint8_t kUntilRelaxed = until(safety::Mode::kRelaxed);
constexpr std::uint8_t kUntilStanding = until(safety::Mode::kStanding);
constexpr std::uint8_t kUntilWalking = until(safety::Mode::kWalking);
constexpr std::uint8_t kUntilSitting = until(safety::Mode::kSitting);

constexpr int gait_id(std::size_t offset) {
  return static_cast<int>((offsetof(Tuning, gait) + offset) / sizeof(float));
}
constexpr int balance_id(std::size_t offset) {
  return static_cast<int>((offsetof(Tuning, balance) + offset) / sizeof(float));
}
constexpr int safety_id(std::size_t offset) {
  return static_cast<int>((offsetof(Tuning, safety) + offset) / sizeof(float));
}

using Script = std::vector<Episode>;
constexpr Request kRelax = Request::kRelax, kStand = Request::kStand, kWalk = Request::kWalk;
constexpr std::uint8_t kItsTime = Episode::kItsTime;

Episode write(int id, float value, Request request = kStand) {
  return {1, kItsTime, request, 0, 0, 0, kWrite, id, value};
}

/// Ready to walk. Short rises leave more ticks for the rest.
void get_up(Script& script) {
  script.insert(script.end(), {{150, kUntilRelaxed, kRelax},
                               write(safety_id(offsetof(SafetyTuning, rise_s)), 0.3F, kRelax),
                               write(safety_id(offsetof(SafetyTuning, sit_s)), 0.2F, kRelax),
                               {1000, kUntilStanding, kStand},
                               {50, kItsTime, kStand, 0, 0, 0, kTremble},
                               {900, kItsTime, kStand}});
}

void start_walking(Script& script) {
  script.push_back({1500, kUntilWalking, kWalk, 1778, 0, 0});
}
void stop_walking(Script& script) {
  script.push_back({2500, kUntilStanding, kStand});
}

void wander(Script& script) {
  start_walking(script);
  script.push_back({10, kItsTime, kWalk, 1778, 0, 0});  // withdraws the order in the first step
  stop_walking(script);
  start_walking(script);
  script.insert(script.end(), {{1800, kItsTime, kWalk, 1778, 0, 0},
                               {300, kItsTime, kWalk, 6000, 0, 0, kYawDrift},
                               {700, kItsTime, kWalk, 0, 500, 300},
                               {700, kItsTime, kWalk, -900, -400, -400, kFeetInAir},
                               {2500, kItsTime, kWalk, 400, 0, 32000, kFeetGone},
                               {300, kItsTime, kWalk, 1000, 0, -3000}});
  stop_walking(script);
  script.push_back({1500, kUntilWalking, kWalk, 0, 600, 0});  // sideways until the end
  script.push_back({1200, kItsTime, kWalk, 0, 600, 0});
  stop_walking(script);
}

/// Values apply while walking begins or continues.
void other_gaits(Script& script, const Params& params) {
  const float leg_m = params.leg[0].thigh_m + params.leg[0].shank_m;
  const Episode changes[] = {
      write(gait_id(offsetof(GaitTuning, cycle_s)), 0.30F, kWalk),
      write(gait_id(offsetof(GaitTuning, hip_height_m)), 0.05F, kWalk),
      write(gait_id(offsetof(GaitTuning, lift_m)), 0.06F, kWalk),
      write(gait_id(offsetof(GaitTuning, hip_height_m)), 0.8F * leg_m, kWalk),
      write(gait_id(offsetof(GaitTuning, joint_delay_s)), 0.030F, kWalk),
      write(gait_id(offsetof(GaitTuning, double_support)), 0.0F, kWalk),
      write(gait_id(offsetof(GaitTuning, joint_delay_s)), 0.0F, kWalk),
      write(gait_id(offsetof(GaitTuning, double_support)), 0.5F, kWalk),
      write(gait_id(offsetof(GaitTuning, look_ahead_s)), 0.0F, kWalk),
      write(gait_id(offsetof(GaitTuning, hip_height_m)), 0.99F * leg_m, kWalk),
      write(gait_id(offsetof(GaitTuning, hip_height_m)), 1.1F * leg_m, kWalk),
      write(balance_id(offsetof(BalanceTuning, gravity_enable)), 0.0F, kWalk),
      write(balance_id(offsetof(BalanceTuning, feedback_enable)), 0.0F, kWalk),
      write(balance_id(offsetof(BalanceTuning, zeros_enable)), 0.0F, kWalk),
      write(balance_id(offsetof(BalanceTuning, multibody_enable)), 0.0F, kWalk),
      write(gait_id(offsetof(GaitTuning, cycle_s)), 2.0F, kWalk)};
  start_walking(script);
  for (const Episode& change : changes) {
    script.push_back(change);
    script.push_back({280, kItsTime, kWalk, 1500, 200, 100});
  }
  script.push_back({400, kItsTime, kWalk, 500, 0, 0, kRestore});
  script.push_back({400, kItsTime, kWalk, 500, 0, 0, kScan});
  stop_walking(script);
  script.insert(script.end(), {write(gait_id(offsetof(GaitTuning, joint_delay_s)), 0.030F, kStand),
                               {20, kItsTime, kStand},
                               write(gait_id(offsetof(GaitTuning, joint_delay_s)), 0.0F, kStand)});
}

void cross_feet(Script& script) {
  const Episode narrow = write(gait_id(offsetof(GaitTuning, half_stance_m)), 0.015F, kWalk);
  start_walking(script);
  script.insert(script.end(), {{300, kItsTime, kWalk, 800, 0, 0},
                               narrow,
                               {900, kItsTime, kWalk, 800, 0, 300},
                               {500, kUntilStanding, kStand},
                               {300, kItsTime, kWalk, 800, 0, 0},
                               {400, kItsTime, kStand, 0, 0, 0, kRestore}});
}

/// A margin wider than the sole: strides shrink until the plan is refused.
void refuse(Script& script) {
  start_walking(script);
  script.push_back(write(gait_id(offsetof(GaitTuning, support_margin_m)), 0.030F, kWalk));
  script.push_back({2600, kItsTime, kWalk, 1000, 0, 0});
  script.push_back({500, kUntilStanding, kStand});
  script.push_back({400, kItsTime, kWalk, 0, 0, 0, kRestore});
}

void silences(Script& script) {
  start_walking(script);
  script.insert(script.end(), {{300, kItsTime, kWalk, 800, 0, 0},
                               {80, kItsTime, kWalk, 800, 0, 0, kSilentServo},
                               {500, kUntilStanding, kStand},
                               {300, kItsTime, kStand}});
  start_walking(script);
  script.push_back({3000, kUntilStanding, kWalk, 800, 0, 0, kQuietOperator});
  script.push_back(write(safety_id(offsetof(SafetyTuning, command_release_s)), 0.6F));
  script.push_back({1200, kUntilRelaxed, kStand, 0, 0, 0, kQuietOperator});
  script.push_back({100, kItsTime, kStand, 0, 0, 0, kQuietOperator});
  get_up(script);
  script.push_back({2800, kUntilRelaxed, kStand, 0, 0, 0, kSilentServo});
  get_up(script);
  script.push_back({700, kUntilSitting, kStand, 0, 0, 0, kFrozenImu});
  get_up(script);
  script.push_back({700, kUntilSitting, kStand, 0, 0, 0, kSilentImu});
  script.push_back({300, kUntilRelaxed, kStand});
  script.push_back({2700, kItsTime, kRelax, 0, 0, 0, kSilentServo});
}

void alarms(Script& script) {
  for (const std::uint32_t each : {kHot | 0U, kLowVoltage | 0U, kServoAlarm | 0U}) {
    start_walking(script);
    script.push_back({2500, kUntilRelaxed, kWalk, 800, 0, 0, each});
    script.push_back({100, kItsTime, kStand, 0, 0, 0, kLate});  // stays down
    get_up(script);
  }
  script.push_back({400, kUntilRelaxed, kRelax});
  script.push_back({60, kItsTime, kStand, 0, 0, 0, kBent});
  get_up(script);
  script.push_back({600, kItsTime, kStand, 0, 0, 0, kTremble});  // shaken, then turned round
  script.push_back({300, kItsTime, kStand, 0, 0, 0, kYawDrift});
  script.push_back({60, kItsTime, kStand, 0, 0, 0, kPressStop});
  script.push_back({60, kItsTime, kRelax, 0, 0, 0, kPressStop});
  script.push_back({60, kItsTime, kStand});
  get_up(script);
  script.push_back(write(safety_id(offsetof(SafetyTuning, fall_tilt_rad)), 0.5F));
  start_walking(script);
  script.push_back({400, kItsTime, kWalk, 800, 0, 0});
  script.push_back({500, kItsTime, kWalk, 800, 0, 0, kTip});
  script.push_back({100, kItsTime, kStand, 0, 0, 0, kTip});
  script.push_back({100, kItsTime, kRelax, 0, 0, 0, kTip});
  script.push_back({500, kItsTime, kRelax, 0, 0, 0, kRight});
  script.push_back({1500, kItsTime, kRelax});
}

Script script_of(const Params& params) {
  Script script;
  get_up(script);
  wander(script);
  script.push_back({400, kItsTime, kRelax, 0, 0, 0});
  get_up(script);
  alarms(script);
  get_up(script);
  silences(script);
  get_up(script);
  other_gaits(script, params);
  refuse(script);
  cross_feet(script);
  script.push_back({100, kItsTime, kStand});
  script.push_back({400, kUntilRelaxed, kRelax, 0, 0, 0, kSilentImu});
  return script;
}

std::int16_t scaled(std::int16_t value, std::int32_t percent) {
  return static_cast<std::int16_t>(value * percent / 100);
}

}  // namespace

Campaign::Campaign(const Params& params, std::uint32_t seed)
    : params_(params), random_(seed), episodes_(script_of(params)) {}

bool Campaign::over(const Outputs& last) const {
  const Episode& now = episodes_[at_];
  const std::uint32_t length = now.ms * 1000 / params_.period_us;
  return ticks_ > 0 && (ticks_ >= length || last.mode == now.until);
}

void Campaign::next() {
  ticks_ = 0;
  if (++at_ < episodes_.size()) return;
  at_ = 0;
  ++round_;
}

void Campaign::send_order(const Episode& now, Inputs& in) {
  if (ticks_ == 0) {
    const std::int32_t percent = round_ == 0 ? 100 : 100 + random_.around_zero(60);
    order_.request = now.request;
    order_.vx_tenth_mm_s = scaled(now.vx_tenth_mm_s, percent);
    order_.vy_tenth_mm_s = scaled(now.vy_tenth_mm_s, percent);
    order_.wz_mrad_s = scaled(now.wz_mrad_s, percent);
    order_.head_pan_mrad = static_cast<std::int16_t>(random_.around_zero(1500));
    order_.head_tilt_mrad = static_cast<std::int16_t>(random_.around_zero(800));
  }
  in.command = order_;
  if ((now.events & kQuietOperator) != 0) return;
  in.command.sequence = ++order_.sequence;
  in.flags |= kCommandFresh;
}

void Campaign::write_parameter(const Episode& now, Inputs& in) const {
  const auto put = [&](int id, float value) {
    in.flags |= kParameterWrite;
    in.parameter_id = static_cast<std::uint16_t>(id);
    in.parameter_bits = std::bit_cast<std::uint32_t>(value);
  };
  const auto nth = static_cast<int>(ticks_);
  if ((now.events & kWrite) != 0 && nth == 0) put(now.id, now.value);
  if ((now.events & kRestore) != 0 && nth < kTuningCount) {
    put(nth, tuning_value(params_.tuning, nth));
  }
  if ((now.events & kScan) == 0) return;
  const Range& range = kTuningRanges[nth % kTuningCount];
  const float wrong[] = {range.high + 1.0F, range.low - 1.0F, std::bit_cast<float>(0x7FC00000U)};
  put(nth % (kTuningCount + 2), wrong[nth % 3]);
}

std::uint32_t Campaign::advance(const Outputs& last, Inputs& in) {
  while (over(last)) next();
  const Episode& now = episodes_[at_];
  send_order(now, in);
  write_parameter(now, in);
  ++ticks_;
  return now.events;
}

}  // namespace verp::replay
