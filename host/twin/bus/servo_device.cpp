#include "host/twin/bus/servo_device.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/twin/bus/servo_registers.hpp"
#include "host/twin/bus/servo_setup.hpp"

namespace verp::bus {
namespace {

using namespace servo;
namespace at = dxl::address;

bool overlaps(std::uint16_t address, std::uint16_t length, std::uint16_t first, std::uint16_t end) {
  return address < end && first < address + length;
}

}  // namespace

ServoDevice::ServoDevice(const ServoIdentity& identity, sim::Plant& plant, int joint)
    : Device(registers_of(identity), model_of(identity.model).indirect),
      model_(model_of(identity.model)),
      plant_(plant),
      joint_(joint),
      fast_sync_read_(identity.fast_sync_read),
      stored_(table_) {
  apply();
}

void ServoDevice::refresh(std::uint16_t address, std::uint16_t length) {
  const bool present = overlaps(address, length, at::kRealtimeTick, at::kBackupReady + 1);
  if (!present && !overlaps(address, length, at::kHardwareError, at::kHardwareError + 1)) return;
  const sim::ServoMeasurement measured = plant_.measure(joint_);
  refresh_motion(measured);
  table_.set(at::kRealtimeTick,
             static_cast<std::int64_t>(plant_.now_us() / 1000) % kRealtimeTickWrap);
  table_.set(at::kPresentPwm, std::llround(sign() * measured.duty * dxl::kFullPwm));
  table_.set(at::kPresentCurrent,
             std::llround(sign() * (model_.has(dxl::kLoad)
                                        ? measured.duty * kLoadFull
                                        : measured.current_a / current_unit_a(model_))));
  table_.set(at::kPresentVoltage, std::llround(measured.voltage_v * 10));
  table_.set(at::kPresentTemperature, std::llround(measured.temperature_c));
  watch_limits(measured);
}

// e-Manual, Homing Offset (20): Present Position is the encoder's count plus this. Position mode
// ignores more than a quarter turn.
std::int32_t ServoDevice::homing() const {
  const auto offset = static_cast<std::int32_t>(table_.get(at::kHomingOffset));
  const bool valid = offset >= -kMostHoming && offset <= kMostHoming;
  return valid || byte(at::kOperatingMode) != dxl::kPositionMode ? offset : 0;
}

// Hardware errors remain until a reboot; those in Shutdown also remove torque.
void ServoDevice::watch_limits(const sim::ServoMeasurement& measured) {
  std::int64_t error = table_.get(at::kHardwareError);
  const double tenth_volts = measured.voltage_v * 10;
  if (tenth_volts > static_cast<double>(table_.get(at::kMaxVoltageLimit)) ||
      tenth_volts < static_cast<double>(table_.get(at::kMinVoltageLimit))) {
    error |= dxl::kInputVoltageError;
  }
  if (measured.temperature_c > static_cast<double>(table_.get(at::kTemperatureLimit))) {
    error |= dxl::kOverheatingError;
  }
  table_.set(at::kHardwareError, error);
  if ((error & table_.get(at::kShutdown)) != 0 && torque_on()) {
    table_.set(at::kTorqueEnable, 0);
    apply();
  }
}

dxl::Error ServoDevice::check(std::uint16_t address, std::span<const std::uint8_t> data) const {
  const dxl::Error error = table_.check(address, data, torque_on());
  if (error != dxl::Error::kNone) return error;
  if (!known(address, data)) return dxl::Error::kDataRange;
  if (tripped()) {
    const auto size = static_cast<std::uint16_t>(data.size());
    if (overlaps(address, size, at::kGoalPwm, at::kProfileAcceleration) ||
        overlaps(address, size, at::kGoalPosition, at::kGoalPosition + 4)) {
      return dxl::Error::kDataRange;
    }
    if (overlaps(address, size, at::kBusWatchdog, at::kBusWatchdog + 1) &&
        data[at::kBusWatchdog - address] != 0) {
      return dxl::Error::kDataRange;
    }
  }
  return within_limits(address, data) ? dxl::Error::kNone : dxl::Error::kDataLimit;
}

bool ServoDevice::known(std::uint16_t address, std::span<const std::uint8_t> data) const {
  const auto written = [&](std::uint16_t at) {
    return address <= at && at < address + data.size() ? data[at - address] : byte(at);
  };
  const std::uint8_t mode = written(at::kOperatingMode);
  const bool of_current = mode == kCurrentMode || mode == kCurrentPositionMode;
  const bool is_mode = mode == kVelocityMode || mode == dxl::kPositionMode || mode == kTurnsMode ||
                       mode == kPwmMode || (of_current && model_.has(dxl::kCurrentControl));
  return is_mode && (written(at::kDriveMode) & 1 << 1) == 0;  // dual joints only
}

// Goals (100 to 104, 116) and Profile Acceleration (108) must stay within the EEPROM limits
// (e-Manual).
bool ServoDevice::within_limits(std::uint16_t address, std::span<const std::uint8_t> data) const {
  const auto inside = [&](std::uint16_t goal, std::int64_t least, std::int64_t most) {
    const Register* reg = table_.find(goal);
    if (reg == nullptr || address > goal || address + data.size() < std::size_t{goal} + reg->size) {
      return true;
    }
    const std::int64_t value = RegisterTable::value_in(*reg, address, data);
    return value >= least && value <= most;
  };
  const auto within = [&](std::uint16_t goal, std::uint16_t limit) {
    return inside(goal, -table_.get(limit), table_.get(limit));
  };
  return within(at::kGoalPwm, at::kPwmLimit) && within(at::kGoalCurrent, at::kCurrentLimit) &&
         within(at::kGoalVelocity, at::kVelocityLimit) &&
         (!model_.has(dxl::kAccelerationBound) ||
          within(at::kProfileAcceleration, at::kAccelerationLimit)) &&
         (byte(at::kOperatingMode) != dxl::kPositionMode ||
          inside(at::kGoalPosition, table_.get(at::kMinPositionLimit),
                 table_.get(at::kMaxPositionLimit)));
}

void ServoDevice::written(std::uint16_t address, std::uint16_t length) {
  const auto touches = [&](std::uint16_t first, std::uint16_t end) {
    return overlaps(address, length, first, end);
  };
  // e-Manual, Operating Mode (11): a new mode resets gains, profile and goals.
  if (mode_ != byte(at::kOperatingMode)) {
    mode_ = byte(at::kOperatingMode);
    table_.restore_initial(at::kVelocityIGain, at::kGoalPosition);
    reset_goals();
  }
  if (touches(at::kPwmLimit, at::kAccelerationLimit)) reset_goals();
  if (touches(at::kGoalPosition, at::kGoalPosition + 4)) goal_written_ = true;
  const bool goal = touches(at::kGoalPwm, at::kProfileAcceleration) ||
                    touches(at::kGoalPosition, at::kGoalPosition + 4);
  if (goal && (byte(at::kDriveMode) & kTorqueOnByGoal) != 0) table_.set(at::kTorqueEnable, 1);
  if ((table_.get(at::kHardwareError) & table_.get(at::kShutdown)) != 0) {
    table_.set(at::kTorqueEnable, 0);
  }
  if (torque_on() && !goal_written_) hold_here();
  apply();
}

void ServoDevice::hold_here() {
  const sim::ServoMeasurement measured = plant_.measure(joint_);
  table_.set(at::kGoalPosition, std::llround(shown(measured.position_count)));
  goal_written_ = true;
}

void ServoDevice::reset_goals() {
  table_.set(at::kGoalPwm, table_.get(at::kPwmLimit));
  table_.set(at::kGoalCurrent, table_.get(at::kCurrentLimit));
  goal_written_ = false;
}

// e-Manual, Bus Watchdog (98): any instruction packet restarts it; it runs with torque on.
std::uint64_t ServoDevice::deadline_us() const {
  const std::uint8_t units = byte(at::kBusWatchdog);
  if (!torque_on() || units == 0 || tripped()) return kNever_us;
  return heard_us_ + std::uint64_t{units} * dxl::kBusWatchdogUnit_us;
}

void ServoDevice::expire() {
  table_.set(at::kBusWatchdog, dxl::kBusWatchdogTripped);
  hold_here();
  table_.set(at::kGoalVelocity, 0);
  if (mode_ == kPwmMode) table_.set(at::kGoalPwm, 0);
  if (mode_ == kCurrentMode) table_.set(at::kGoalCurrent, 0);
  apply();
}

void ServoDevice::restarted() {
  mode_ = byte(at::kOperatingMode);
  table_.set(at::kBackupReady, stored_.get(at::kBackupReady));
  reset_goals();
  apply();
}

bool ServoDevice::moving() {
  refresh(at::kMoving, 1);
  return byte(at::kMoving) != 0;
}

}  // namespace verp::bus
