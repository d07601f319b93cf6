#include <algorithm>
#include <cmath>

#include "host/twin/bus/servo_device.hpp"
#include "host/twin/bus/servo_registers.hpp"

namespace verp::bus {

using namespace servo;
namespace at = dxl::address;

void ServoDevice::refresh_motion(const sim::ServoMeasurement& measured) {
  const std::int64_t velocity = std::llround(sign() * measured.velocity_rad_s / kVelocityUnitRadS);
  const bool profiles = torque_on() && measured.profile_ongoing;
  const bool moves = profiles || std::abs(velocity) > table_.get(at::kMovingThreshold);
  table_.set(at::kMoving, moves ? 1 : 0);
  table_.set(at::kMovingStatus, moving_status(measured));
  table_.set(at::kPresentVelocity, velocity);
  table_.set(at::kPresentPosition, std::llround(shown(measured.position_count)));
  table_.set(at::kVelocityTrajectory,
             std::llround(sign() * measured.trajectory_count_s / kVelocityUnitCountS));
  table_.set(at::kPositionTrajectory, torque_on() && steers_position()
                                          ? std::llround(shown(measured.trajectory_count))
                                          : table_.get(at::kGoalPosition));
}

std::uint8_t ServoDevice::moving_status(const sim::ServoMeasurement& measured) const {
  if (!torque_on()) return 0;
  auto status = static_cast<std::uint8_t>(static_cast<unsigned>(measured.profile) << 4);
  if (measured.profile_ongoing) status |= kOngoing;
  if (!steers_position()) return status;
  const double goal = meant_count(table_.get(at::kGoalPosition));
  if (std::abs(goal - measured.position_count) <= kInPositionCount) status |= kInPosition;
  if (std::abs(measured.trajectory_count - measured.position_count) > kFollowingCount) {
    status |= kNotFollowing;
  }
  return status;
}

bool ServoDevice::steers_position() const {
  const std::uint8_t mode = byte(at::kOperatingMode);
  return mode == dxl::kPositionMode || mode == kTurnsMode || mode == kCurrentPositionMode;
}

// e-Manual, Drive Mode (10): mirrored about the middle of the turn.
bool ServoDevice::reverse() const {
  return (byte(at::kDriveMode) & kReverse) != 0;
}

double ServoDevice::shown(double count) const {
  return (reverse() ? kCountsPerTurn - count : count) + homing();
}

std::int32_t ServoDevice::meant_count(std::int64_t shown) const {
  const auto count = static_cast<std::int32_t>(shown) - homing();
  return reverse() ? static_cast<std::int32_t>(kCountsPerTurn) - count : count;
}

void ServoDevice::apply() {
  const auto unsigned16 = [this](std::uint16_t address) {
    return static_cast<std::uint16_t>(table_.get(address));
  };
  const auto number = [this](std::uint16_t address) {
    return static_cast<double>(table_.get(address));
  };
  sim::ServoSetpoint& setpoint = plant_.setpoint(joint_);
  setpoint.torque_on = torque_on();
  setpoint.goal_count = meant_count(table_.get(at::kGoalPosition));
  setpoint.p_gain = unsigned16(at::kPositionPGain);
  setpoint.i_gain = unsigned16(at::kPositionIGain);
  setpoint.d_gain = unsigned16(at::kPositionDGain);
  setpoint.velocity_p_gain = unsigned16(at::kVelocityPGain);
  setpoint.velocity_i_gain = unsigned16(at::kVelocityIGain);
  const std::int64_t goal_pwm = table_.get(at::kGoalPwm);
  // Goal PWM is the goal in PWM mode, else a limit.
  setpoint.pwm_limit = static_cast<std::uint16_t>(
      std::min(table_.get(at::kPwmLimit),
               mode_ == kPwmMode ? table_.get(at::kPwmLimit) : std::abs(goal_pwm)));
  setpoint.mode = mode_ == kVelocityMode  ? sim::ServoMode::kVelocity
                  : mode_ == kCurrentMode ? sim::ServoMode::kCurrent
                  : mode_ == kPwmMode     ? sim::ServoMode::kPwm
                                          : sim::ServoMode::kPosition;
  setpoint.goal_pwm = static_cast<double>(sign() * goal_pwm);
  setpoint.goal_count_s = sign() * number(at::kGoalVelocity) * kVelocityUnitCountS;
  setpoint.goal_a = sign() * number(at::kGoalCurrent) * current_unit_a(model_);
  setpoint.current_limit_a = mode_ == kCurrentPositionMode ? std::abs(setpoint.goal_a) : -1;
  apply_profile(setpoint);
}

void ServoDevice::apply_profile(sim::ServoSetpoint& setpoint) const {
  const std::int64_t velocity = table_.get(at::kProfileVelocity);
  const auto acceleration = static_cast<double>(table_.get(at::kProfileAcceleration));
  const bool timed = (byte(at::kDriveMode) & dxl::kTimeBasedProfile) != 0;
  setpoint.profile_ms = timed ? static_cast<std::uint32_t>(velocity) : 0;
  setpoint.accelerate_ms = timed ? acceleration : 0;
  setpoint.profile_count_s = timed ? 0 : static_cast<double>(velocity) * kVelocityUnitCountS;
  setpoint.accelerate_count_s2 = timed ? 0 : acceleration * kAccelerationUnitCountS2;
  if (timed && mode_ == kVelocityMode && acceleration > 0) {
    setpoint.accelerate_count_s2 = std::abs(setpoint.goal_count_s) / (acceleration * 1e-3);
  }
}

}  // namespace verp::bus
