#include "tests/hil/run_watch.hpp"

#include <algorithm>

namespace verp::test {
namespace {

constexpr std::uint64_t kLimp_us = 1'500'000;  // within this, torque off reaches every servo
constexpr std::uint64_t kFall_us = 1'000'000;  // to confirm a tilt

}  // namespace

void RunWatch::note_positions(const Outputs& last) {
  for (int j = 0; j < params_.joint_count; ++j) {
    const std::int32_t stands = plant_.measure(j).position_count;
    const sim::ServoSetpoint& setpoint = plant_.setpoint(j);
    tells_[static_cast<std::size_t>(j)] =
        setpoint.torque_on ? std::minmax({stands, setpoint.goal_count, last.goal_count[j]})
                           : std::pair{stands, stands};
  }
}

void RunWatch::watch_positions(const Inputs& inputs, int repeats) {
  for (int j = 0; j < params_.joint_count; ++j) {
    const auto [low, high] = tells_[static_cast<std::size_t>(j)];
    const bool fresh = (inputs.fresh >> j & 1) != 0 && j != repeats;
    if (fresh && (inputs.position_count[j] < low || inputs.position_count[j] > high)) {
      fault("joint " + std::to_string(j) + "'s position was old");
    }
  }
}

void RunWatch::watch_silence(const Inputs& inputs) {
  std::uint64_t longest =
      (inputs.flags & kImuFresh) != 0 ? silent_[kMaxJoints] = 0 : ++silent_[kMaxJoints];
  for (std::size_t j = 0; j < static_cast<std::size_t>(params_.joint_count); ++j) {
    silent_[j] = (inputs.fresh >> j & 1) != 0 ? 0 : silent_[j] + 1;
    longest = std::max(longest, silent_[j]);
  }
  const double half_s = seconds(1) / 2;  // the core may round either way
  stale_ = stale_ || seconds(longest) > params_.tuning.safety.stale_hold_s - half_s;
}

void RunWatch::watch_torque(const Outputs& outputs, std::uint64_t now_us, bool cut, int gone) {
  if (outputs.torque_enable != 0 || cut) limp_since_us_ = now_us;
  if (now_us < limp_since_us_ + kLimp_us) return;
  for (int j = 0; j < params_.joint_count; ++j) {
    if (j != gone && plant_.setpoint(j).torque_on) {
      fault("joint " + std::to_string(j) + " kept its torque on a limp robot");
    }
  }
}

void RunWatch::watch_fall(const Outputs& outputs, std::uint64_t now_us, bool lies) {
  if (!lies) fallen_us_ = now_us;
  if (now_us < fallen_us_ + kFall_us) return;
  if (outputs.torque_enable != 0) fault("it has fallen, and is not limp");
}

}  // namespace verp::test
