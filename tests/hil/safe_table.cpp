#include "tests/hil/safe_table.hpp"

#include <algorithm>
#include <cmath>

#include "common/model/tree.hpp"
#include "tests/hil/modes.hpp"

namespace verp::test {
namespace {

constexpr std::uint32_t bit(int mode) {
  return 1u << mode;
}

constexpr std::uint32_t kDown = bit(kFalling) | bit(kFallen) | bit(kStopped);

constexpr std::uint32_t kMayLeadTo[] = {
    /* relaxed  */ bit(kRising) | bit(kGettingUp) | bit(kStopped),
    /* rising   */ bit(kStanding) | bit(kHolding) | bit(kSitting) | kDown,
    /* standing */ bit(kWalking) | bit(kActing) | bit(kHolding) | bit(kSitting) | kDown,
    /* walking  */ bit(kStanding) | bit(kHolding) | kDown,
    /* holding  */ bit(kRising) | bit(kSitting) | bit(kFallen) | bit(kStopped),
    /* sitting  */ bit(kRelaxed) | bit(kLyingDown) | kDown,
    /* fallen   */ bit(kRelaxed) | bit(kGettingUp) | bit(kStopped),
    /* stopped  */ bit(kRelaxed),
    /* acting   */ bit(kStanding) | bit(kHolding) | kDown,
    /* falling  */ bit(kHolding) | bit(kFallen) | bit(kStopped),
    /* getting up */ bit(kStanding) | bit(kHolding) | bit(kFallen) | bit(kStopped),
    /* lying down */ bit(kRelaxed) | bit(kStopped)};

bool limp(int mode) {
  return mode == kRelaxed || mode == kFallen || mode == kStopped;
}
bool moving(int mode) {
  return mode == kRising || mode == kStanding || mode == kWalking || mode == kActing ||
         mode == kGettingUp;
}

}  // namespace

SafeTable::SafeTable(const Params& params) : params_(params) {}

void SafeTable::fault(const std::string& what) {
  if (violation_.empty()) violation_ = "tick " + std::to_string(tick_) + ": " + what;
}

// Counts periods; without a tick, nothing was heard.
void SafeTable::count_silence(const Inputs& inputs) {
  const std::uint32_t periods = begun_ ? std::min(inputs.tick - tick_, kForEver) : kForEver;
  const auto count = [periods](std::uint32_t& silent, bool heard) {
    silent = heard ? 0 : std::min(silent + periods, kForEver);
  };
  constexpr int kAxes = 3;
  if ((inputs.flags & kImuFresh) != 0) {
    const bool stirs = !begun_ || !std::equal(gyro_, gyro_ + kAxes, inputs.gyro_count) ||
                       !std::equal(accel_, accel_ + kAxes, inputs.accel_count);
    alike_ = stirs ? 0 : alike_ + 1;
    std::copy_n(inputs.gyro_count, kAxes, gyro_);
    std::copy_n(inputs.accel_count, kAxes, accel_);
  }
  const bool assumed = (inputs.flags & kImuAssumed) != 0;  // there is no IMU
  const bool heard = (inputs.flags & kImuFresh) != 0 && (assumed || alike_ < kFrozen);
  count(imu_silent_, heard);
  count(imu_perhaps_, heard && (stirs(inputs) || assumed));
  count(operator_silent_, (inputs.flags & kCommandFresh) != 0);
  silent_ = std::max(imu_silent_, begun_ ? periods - 1 : 0);
  perhaps_silent_ = std::max(imu_perhaps_, silent_);
  for (int j = 0; j < params_.joint_count; ++j) {
    const bool read = (inputs.fresh >> j & 1u) != 0;
    if (read) follow_joint(j, inputs.position_count[j]);
    const double due = joint_[j].due(), away = std::abs(joint_[j].away);
    count(servo_silent_[j], read && due < 0.23 && away < 0.53);
    count(servo_perhaps_[j], read && due < 0.17 && away < 0.47);
    silent_ = std::max(silent_, servo_silent_[j]);
    perhaps_silent_ = std::max(perhaps_silent_, servo_perhaps_[j]);
  }
}

void SafeTable::follow_joint(int j, std::int32_t count) {
  constexpr double kLag_s = 0.02, kStays_rad = 0.01;
  const double period_s = 1e-6 * params_.period_us;
  const double per_rad = params_.joint[j].counts_per_rad;
  const double here = count / per_rad, goal = goal_[j] / per_rad;
  Joint& joint = joint_[j];
  const bool moves = limp(mode_) || mode_ == kActing || mode_ >= kFalling;
  if (moves) {
    joint = {here, here, 0, 0, 0};
    return;
  }
  joint.model += (goal - joint.model) * period_s / (kLag_s + period_s);
  joint.away = joint.model - here;
  if (std::abs(here - joint.stays) > kStays_rad) {
    joint.stays = here;
    joint.low = joint.high = joint.away;
  }
  joint.low = std::min(joint.low, joint.away);
  joint.high = std::max(joint.high, joint.away);
}

// Two axes of the gyro and two of the accelerometer.
bool SafeTable::stirs(const Inputs& inputs) {
  constexpr std::uint32_t kReadings = 18;
  constexpr int kMoves = 4;
  int moved[2] = {};
  for (int i = 0; i < 6; ++i) {
    const std::int16_t count = i < 3 ? inputs.gyro_count[i] : inputs.accel_count[i - 3];
    const bool moves = std::abs(count - axis_at_[i]) > kMoves;
    if (moves) axis_at_[i] = count;
    axis_still_[i] = moves ? 0 : std::min(axis_still_[i] + 1, kForEver);
    if (axis_still_[i] < kReadings) ++moved[i / 3];
  }
  return moved[0] >= 2 && moved[1] >= 2;
}

// The IMU shows how a push turns or leans a robot.
void SafeTable::count_push(const Inputs& inputs) {
  constexpr double kTurns_rad_s = 0.3, kLeans_m_s2 = 1.0;
  const auto most = [](const std::int16_t* count, int axes, double per_count) {
    double value = 0;
    for (int i = 0; i < axes; ++i) value = std::max(value, std::abs(count[i] * per_count));
    return value;
  };
  const bool moved =
      (inputs.flags & kImuFresh) != 0 &&
      (most(inputs.gyro_count, 3, double{params_.imu.gyro_rad_s_per_count}) > kTurns_rad_s ||
       most(inputs.accel_count, 2, double{params_.imu.accel_m_s2_per_count}) > kLeans_m_s2);
  const std::uint32_t periods = begun_ ? std::min(inputs.tick - tick_, kForEver) : kForEver;
  unmoved_ = moved ? 0 : std::min(unmoved_ + periods, kForEver);
}

void SafeTable::count_trouble(const Inputs& inputs, int to) {
  const SafetyTuning& safety = params_.tuning.safety;
  if ((inputs.flags & kSlowFresh) != 0 && inputs.slow_joint < params_.joint_count) {
    const bool bad =
        inputs.slow_error != 0 || inputs.slow_temperature_c > safety.temperature_high_c;
    int& count = servo_bad_[inputs.slow_joint];
    count = bad ? count + 1 : 0;
    supply_low_ = 0.1 * inputs.slow_voltage_tenth_v < safety.voltage_low_v ? supply_low_ + 1 : 0;
  }
  const bool bad =
      supply_low_ >= kSupply || std::any_of(servo_bad_, servo_bad_ + params_.joint_count,
                                            [](int count) { return count >= kAlarm; });
  const bool asked = inputs.command.request == Request::kRelax;
  if (mode_ == kRelaxed && to == kRelaxed && asked) trouble_ = perhaps_trouble_ = false;
  trouble_ = trouble_ || bad;
  count_doubt(inputs);
  perhaps_trouble_ = perhaps_trouble_ || trouble_;
}

void SafeTable::count_doubt(const Inputs& inputs) {
  const double period_s = 1e-6 * params_.period_us;
  const SafetyTuning& safety = params_.tuning.safety;
  for (int j = 0; j < params_.joint_count; ++j) {
    const bool read = (inputs.fresh >> j & 1u) != 0;
    if (read && servo_perhaps_[j] * period_s > safety.stale_hold_s - period_s) {
      perhaps_trouble_ = true;
    }
  }
  double load_n = 0;
  for (const auto& foot : inputs.foot_count) {
    for (const std::uint16_t count : foot) load_n += count * params_.feet.newton_per_count;
  }
  const double weight_n = 9.8 * model::total_mass(params_);
  const bool stands = mode_ == kStanding || mode_ == kWalking;
  const bool bears = (inputs.flags & kFeetFresh) == 0 || load_n > 0.25 * weight_n;
  unloaded_ = stands && !bears ? unloaded_ + 1 : 0;
  if (unloaded_ * period_s > safety.unloaded_s - period_s) perhaps_trouble_ = true;
}

// Each silence that holds the robot counts for three seconds.
void SafeTable::count_flutter(int to) {
  const int period_us = static_cast<int>(params_.period_us);
  flutter_us_ = to == kRelaxed ? 0 : std::max(0, flutter_us_ - period_us);
  if (to == kHolding && mode_ != kHolding && perhaps_silent_ > 0)
    flutter_us_ += kHeld_s * 1'000'000;
  trouble_ = trouble_ || flutter_us_ > kFlutter_s * 1'000'000;
}

void SafeTable::check_trouble(int to) {
  constexpr double kLongestEnd_s = 4;  // up to four planned steps
  trouble_ticks_ = trouble_ && to == kWalking ? trouble_ticks_ + 1 : 0;
  if (1e-6 * params_.period_us * trouble_ticks_ > kLongestEnd_s) fault("walks on in trouble");
  if (!trouble_) return;
  if (to != mode_ && (to == kRising || to == kWalking || to == kActing || to == kGettingUp)) {
    fault(std::string("in trouble, and ") + kModeNames[mode_] + " became " + kModeNames[to]);
  }
  if (to == mode_ && (to == kRising || to == kStanding)) {
    fault(std::string("in trouble, and it goes on ") + kModeNames[to]);
  }
}

// A minimum-jerk curve peaks at 15/8 of its average speed, which the joint must allow.
void SafeTable::check_way(const Outputs& outputs, int to) {
  const bool begins = to != mode_ && (to == kRising || to == kSitting);
  const bool ends = (mode_ == kRising && to == kStanding) ||
                    (mode_ == kSitting && (to == kRelaxed || to == kLyingDown));
  for (int j = 0; j < params_.joint_count; ++j) {
    if (begins) from_[j] = outputs.goal_count[j];
    if (!ends) continue;
    const JointParams& joint = params_.joint[j];
    const double way_rad =
        (outputs.goal_count[j] - from_[j]) / std::abs(double{joint.counts_per_rad});
    const double least_s = 15.0 / 8 * std::abs(way_rad) / joint.velocity_limit_rad_s;
    if (1e-6 * params_.period_us * (in_mode_ticks_ + 1) < least_s - 0.02) {
      fault("joint " + std::to_string(j) + " had too little time for its way");
    }
  }
}

void SafeTable::check_transition(const Inputs& inputs, int to) {
  const SafetyTuning& safety = params_.tuning.safety;
  const auto longer = [&](std::uint32_t ticks, double duration_s) {
    return 1e-6 * params_.period_us * ticks >= duration_s - 1e-6;
  };
  // If the period does not divide the time, the core may be early by half a period.
  const auto nearly = [&](std::uint32_t ticks, double duration_s) {
    return longer(ticks, duration_s - 0.5e-6 * params_.period_us);
  };
  const bool stale = longer(silent_, safety.stale_hold_s);
  const bool lost = longer(silent_, safety.stale_release_s);
  const Request request = inputs.command.request;
  const auto nobody_watches = [&] {
    return longer(operator_silent_, safety.command_hold_s + 0.02);
  };
  if (to != mode_ && (kMayLeadTo[mode_] & bit(to)) == 0) {
    return fault(std::string(kModeNames[mode_]) + " became " + kModeNames[to]);
  }
  const GaitTuning& gait = params_.tuning.gait;
  const double stops_s = safety.command_hold_s + 2 * gait.cycle_s + 2 * gait.start_s + 0.1;
  if (to == kWalking && longer(operator_silent_, stops_s)) fault("walks on with nobody watching");
  if (moving(to) && stale) fault(std::string(kModeNames[to]) + " though a device is silent");
  if (to == kHolding && mode_ == kHolding && lost) fault("holding though a device is lost");
  if (to == mode_) return;
  if (to == kHolding && mode_ != kFalling && !nearly(perhaps_silent_, safety.stale_hold_s))
    fault("holding without a silent device");
  if (mode_ == kHolding && to == kSitting && !nearly(perhaps_silent_, safety.stale_release_s) &&
      request != Request::kRelax && !perhaps_trouble_) {
    fault("sitting down though nobody asked, nothing is lost and power is good");
  }
  if (mode_ == kStanding && to == kSitting && request != Request::kRelax && !perhaps_trouble_ &&
      !longer(operator_silent_, safety.command_release_s)) {
    fault("sitting down though the operator is there");
  }
  if (to == kRising && mode_ == kRelaxed && request == Request::kRelax) fault("rose unasked");
  if (to == kGettingUp && request != Request::kGetUp) fault("got up unasked");
  if (to == kGettingUp && !longer(static_cast<std::uint32_t>(in_mode_ticks_ + 1), kLies_s)) {
    fault("got up before it lay still");
  }
  if (mode_ == kFalling && to != kStopped &&
      !longer(static_cast<std::uint32_t>(in_mode_ticks_ + 1), kFalls_s)) {
    fault("fell too short");
  }
  if (to == kRelaxed && mode_ == kLyingDown &&
      !longer(static_cast<std::uint32_t>(in_mode_ticks_ + 1), kLiesDown_s)) {
    fault("lay down too fast");
  }
  if (to == kActing && request == Request::kRelax) fault("acted unasked");
  if ((to == kActing || to == kGettingUp) && nobody_watches()) {
    fault(std::string(kModeNames[to]) + " with nobody watching");
  }
  if (to == kWalking && request != Request::kWalk &&
      (request == Request::kRelax || longer(unmoved_, kPushed_s))) {
    fault("walked unasked, and nobody pushed it");
  }
  if (to == kWalking && nobody_watches()) fault("walked with nobody watching");
  if (to == kStanding && mode_ == kRising &&
      !longer(static_cast<std::uint32_t>(in_mode_ticks_ + 1), safety.rise_s)) {
    fault("rose too fast");
  }
  if (to == kRelaxed && mode_ == kSitting &&
      !longer(static_cast<std::uint32_t>(in_mode_ticks_ + 1), safety.sit_s)) {
    fault("let go before it sat");
  }
  if (to == kRelaxed && (mode_ == kFallen || mode_ == kStopped) && request != Request::kRelax) {
    fault("left " + std::string(kModeNames[mode_]) + " unasked");
  }
}

// A tick decides its mode last: the new mode's goals follow a tick later. Torque goes off at once.
void SafeTable::check_goals(const Inputs& inputs, const Outputs& outputs) {
  for (int j = 0; j < params_.joint_count; ++j) {
    const JointParams& joint = params_.joint[j];
    const double one =
        joint.zero_count + static_cast<double>(joint.counts_per_rad) * joint.lower_rad;
    const double other =
        joint.zero_count + static_cast<double>(joint.counts_per_rad) * joint.upper_rad;
    const double low = std::min(one, other), high = std::max(one, other);
    const double goal = outputs.goal_count[j];
    const double slack = kBeyond_rad * std::abs(joint.counts_per_rad) + 1;
    const double stands = inputs.position_count[j];
    const bool rises = limp(mode_) && (outputs.mode == kRising || outputs.mode == kGettingUp);
    if (rises && (stands < low - slack || stands > high + slack)) {
      fault("rose though joint " + std::to_string(j) + " stands beyond its limits");
    }
    if (goal < low - 1 || goal > high + 1)
      fault("goal of joint " + std::to_string(j) + " beyond its limits");
    const double step = std::abs(goal - goal_[j]);
    const double most =
        1e-6 * params_.period_us * joint.velocity_limit_rad_s * std::abs(joint.counts_per_rad);
    if (limp(mode_)) {
      const double here = std::clamp<double>(inputs.position_count[j], low, high);
      if (std::abs(goal - here) > 1.5)
        fault("limp, and goal " + std::to_string(j) + " is not where the joint is");
    } else if (mode_ == kHolding && step > 0) {
      fault("holding, and goal " + std::to_string(j) + " moves");
    } else if (step > most + 1.5) {
      fault("goal of joint " + std::to_string(j) + " faster than the joint may be");
    }
    goal_[j] = outputs.goal_count[j];
  }
}

void SafeTable::check_outputs(const Inputs& inputs, const Outputs& outputs, int to) {
  const std::uint32_t all = params_.joint_count >= 32 ? ~0u : (1u << params_.joint_count) - 1;
  if (limp(to) && outputs.torque_enable != 0) fault(std::string(kModeNames[to]) + " with torque");
  if (!limp(to) && outputs.torque_enable != all)
    fault(std::string(kModeNames[to]) + " without torque");
  check_goals(inputs, outputs);
}

void SafeTable::tick(const Inputs& inputs, const Outputs& outputs) {
  if (begun_ && inputs.tick <= tick_) fault("time stands still");
  const int to = outputs.mode;
  if (to > kLyingDown) return fault("no such mode");
  count_silence(inputs);
  count_push(inputs);
  tick_ = inputs.tick;
  count_trouble(inputs, to);
  count_flutter(to);
  if (silent_ == 0) check_trouble(to);
  check_way(outputs, to);
  check_transition(inputs, to);
  check_outputs(inputs, outputs, to);
  in_mode_ticks_ = to == mode_ ? in_mode_ticks_ + 1 : 0;
  mode_ = to;
  seen_ |= bit(to);
  begun_ = true;
}

}  // namespace verp::test
