#include "host/bus/servo_device.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/bus/servo_setup.hpp"

namespace verp::bus {
namespace {

namespace at = dxl::address;

// Units of the control table; source: e-Manual, XM430-W210 and MX-28(2.0).
constexpr double kVelocityUnitRadS = 0.229 * 2.0 * std::numbers::pi / 60.0;
constexpr double kCurrentUnitA = 0.00269;  // X-series, Present Current
constexpr double kLoadFull = 1000;         // MX(2.0), Present Load in 0.1 %
constexpr std::int64_t kRealtimeTickWrap = 32768;

bool overlaps(std::uint16_t address, std::uint16_t length, std::uint16_t first, std::uint16_t end) {
  return address < end && first < address + length;
}

// Initial values and ranges: e-Manual, as control_table.hpp. Current registers are the X-series'
// own, Acceleration Limit the MX's.
std::vector<Register> servo_registers(const ServoIdentity& identity) {
  const bool mx = identity.model < 1000;
  constexpr std::int64_t kTurn = 1044479;  // Homing Offset's range
  constexpr std::int64_t kGain = 16383;
  std::vector<Register> registers = {
      {at::kModelNumber, 2, false, identity.model},
      {at::kModelInformation, 4, false, 0},
      {at::kFirmwareVersion, 1, false, 45},  // first with Fast Sync Read
      {at::kId, 1, true, identity.id, 0, dxl::kMaxId},
      {at::kBaudRate, 1, true, dxl::baud_rate_code(identity.baud), 0, 7},
      {at::kReturnDelay, 1, true, 250, 0, 254},
      {at::kDriveMode, 1, true, 0, 0, 5},
      {at::kOperatingMode, 1, true, dxl::kPositionMode, 0, 16},
      {at::kSecondaryId, 1, true, 255, 0, 255},
      {at::kProtocolVersion, 1, true, 2, 1, 2},
      {at::kHomingOffset, 4, true, 0, -kTurn, kTurn},
      {at::kMovingThreshold, 4, true, 10, 0, 1023},
      {at::kTemperatureLimit, 1, true, 80, 0, 100},
      {at::kMaxVoltageLimit, 2, true, 160, 95, 160},
      {at::kMinVoltageLimit, 2, true, 95, 95, 160},
      {at::kPwmLimit, 2, true, dxl::kFullPwm, 0, dxl::kFullPwm},
      {at::kCurrentLimit, 2, true, 1193, 0, 1193},
      {at::kAccelerationLimit, 4, true, 32767, 0, 32767},
      {at::kVelocityLimit, 4, true, mx ? 380 : 330, 0, 1023},
      {at::kMaxPositionLimit, 4, true, 4095, 0, 4095},
      {at::kMinPositionLimit, 4, true, 0, 0, 4095},
      {at::kShutdown, 1, true, 52, 0, 255},
      {at::kTorqueEnable, 1, true, 0, 0, 1},
      {at::kLed, 1, true, 0, 0, 1},
      {at::kStatusReturnLevel, 1, true, 2, 0, 2},
      {at::kRegisteredInstruction, 1, false, 0},
      {at::kHardwareError, 1, false, 0},
      {at::kVelocityIGain, 2, true, 1920, 0, kGain},
      {at::kVelocityPGain, 2, true, 100, 0, kGain},
      {at::kPositionDGain, 2, true, 0, 0, kGain},
      {at::kPositionIGain, 2, true, 0, 0, kGain},
      {at::kPositionPGain, 2, true, mx ? 850 : 800, 0, kGain},
      {at::kFeedforward2Gain, 2, true, 0, 0, kGain},
      {at::kFeedforward1Gain, 2, true, 0, 0, kGain},
      {at::kBusWatchdog, 1, true, 0, 0, dxl::kBusWatchdogMost},
      {at::kGoalPwm, 2, true, dxl::kFullPwm, -dxl::kFullPwm, dxl::kFullPwm},
      {at::kGoalCurrent, 2, true, 1193, -1193, 1193},
      {at::kGoalVelocity, 4, true, 0, -1023, 1023},
      {at::kProfileAcceleration, 4, true, 0, 0, 32767},
      {at::kProfileVelocity, 4, true, 0, 0, 32767},
      {at::kGoalPosition, 4, true, 0, -kTurn, kTurn},
      {at::kRealtimeTick, 2, false, 0},
      {at::kMoving, 1, false, 0},
      {at::kMovingStatus, 1, false, 0},
      {at::kPresentPwm, 2, false, 0, -1},
      {at::kPresentCurrent, 2, false, 0, -1},
      {at::kPresentVelocity, 4, false, 0, -1},
      {at::kPresentPosition, 4, false, 0, -1},
      {at::kVelocityTrajectory, 4, false, 0, -1},
      {at::kPositionTrajectory, 4, false, 0, -1},
      {at::kPresentVoltage, 2, false, 120},
      {at::kPresentTemperature, 1, false, 25},
      {at::kBackupReady, 1, false, 0},
  };
  for (const auto& [addresses, data] : {std::pair{at::kIndirectAddress1, at::kIndirectData1},
                                        std::pair{at::kIndirectAddress29, at::kIndirectData29}}) {
    for (std::uint16_t n = 0; n < dxl::kIndirectBlock; ++n) {
      registers.push_back({static_cast<std::uint16_t>(addresses + 2 * n), 2, true, data + n,
                           dxl::kIndirectFirst, dxl::kIndirectLast});
    }
    for (std::uint16_t n = 0; n < dxl::kIndirectBlock; ++n) {
      registers.push_back({static_cast<std::uint16_t>(data + n), 1, true, 0, 0, 255});
    }
  }
  std::erase_if(registers, [mx](const Register& reg) {
    if (mx) return reg.address == at::kCurrentLimit || reg.address == at::kGoalCurrent;
    return reg.address == at::kAccelerationLimit;
  });
  return registers;
}

}  // namespace

ServoDevice::ServoDevice(const ServoIdentity& identity, sim::Plant& plant, int joint)
    : Device(servo_registers(identity)),
      plant_(plant),
      joint_(joint),
      fast_sync_read_(identity.fast_sync_read) {
  apply();
}

void ServoDevice::refresh(std::uint16_t address, std::uint16_t length) {
  const bool present = overlaps(address, length, at::kRealtimeTick, at::kBackupReady + 1);
  if (!present && !overlaps(address, length, at::kHardwareError, at::kHardwareError + 1)) return;
  const sim::ServoMeasurement measured = plant_.measure(joint_);
  const std::int64_t velocity = std::llround(measured.velocity_rad_s / kVelocityUnitRadS);
  const bool has_current = table_.find(at::kGoalCurrent) != nullptr;
  table_.set(at::kRealtimeTick,
             static_cast<std::int64_t>(plant_.now_us() / 1000) % kRealtimeTickWrap);
  table_.set(at::kMoving, std::abs(velocity) > table_.get(at::kMovingThreshold) ? 1 : 0);
  table_.set(at::kPresentPwm, std::llround(measured.duty * dxl::kFullPwm));
  table_.set(at::kPresentCurrent, has_current ? std::llround(measured.current_a / kCurrentUnitA)
                                              : std::llround(measured.duty * kLoadFull));
  table_.set(at::kPresentVelocity, velocity);
  table_.set(at::kPresentPosition, measured.position_count + homing());
  table_.set(at::kPositionTrajectory, table_.get(at::kGoalPosition));
  table_.set(at::kPresentVoltage, std::llround(measured.voltage_v * 10));
  table_.set(at::kPresentTemperature, std::llround(measured.temperature_c));
  watch_limits(measured);
}

// e-Manual, Homing Offset (20): Present Position is the encoder's plus this; in position mode more
// than a quarter turn is ignored.
std::int32_t ServoDevice::homing() const {
  const auto offset = static_cast<std::int32_t>(table_.get(at::kHomingOffset));
  const bool valid = offset >= -kMostHoming && offset <= kMostHoming;
  return valid || byte(at::kOperatingMode) != dxl::kPositionMode ? offset : 0;
}

// A hardware error stays until reboot; those that Shutdown selects also take the torque away.
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

// e-Manual, Goal PWM (100) and Goal Position (116): not beyond what the limits in EEPROM say.
bool ServoDevice::within_limits(std::uint16_t address, std::span<const std::uint8_t> data) const {
  const auto inside = [&](std::uint16_t goal, std::int64_t least, std::int64_t most) {
    const Register& reg = *table_.find(goal);
    if (address > goal || address + data.size() < std::size_t{goal} + reg.size) return true;
    const std::int64_t value = RegisterTable::value_in(reg, address, data);
    return value >= least && value <= most;
  };
  const std::int64_t pwm = table_.get(at::kPwmLimit);
  return inside(at::kGoalPwm, -pwm, pwm) &&
         (byte(at::kOperatingMode) != dxl::kPositionMode ||
          inside(at::kGoalPosition, table_.get(at::kMinPositionLimit),
                 table_.get(at::kMaxPositionLimit)));
}

void ServoDevice::written(std::uint16_t address, std::uint16_t length) {
  // e-Manual, Operating Mode (11): a new mode resets gains, profile and goals.
  if (mode_ != byte(at::kOperatingMode)) {
    mode_ = byte(at::kOperatingMode);
    table_.restore_initial(at::kVelocityIGain, at::kGoalPosition);
    goal_written_ = false;
  }
  if (overlaps(address, length, at::kGoalPosition, at::kGoalPosition + 4)) goal_written_ = true;
  if ((table_.get(at::kHardwareError) & table_.get(at::kShutdown)) != 0) {
    table_.set(at::kTorqueEnable, 0);
  }
  if (torque_on() && !goal_written_) {
    table_.set(at::kGoalPosition, plant_.measure(joint_).position_count + homing());
    goal_written_ = true;
  }
  apply();
}

// e-Manual, Bus Watchdog (98): counts instruction packets for anybody, and only with torque on.
std::uint64_t ServoDevice::deadline_us() const {
  const std::uint8_t units = byte(at::kBusWatchdog);
  if (!torque_on() || units == 0 || tripped()) return kNever_us;
  return heard_us_ + std::uint64_t{units} * dxl::kBusWatchdogUnit_us;
}

void ServoDevice::expire() {
  table_.set(at::kBusWatchdog, dxl::kBusWatchdogTripped);
  table_.set(at::kGoalPosition, plant_.measure(joint_).position_count + homing());
  apply();
}

void ServoDevice::restarted() {
  mode_ = byte(at::kOperatingMode);
  goal_written_ = false;
  apply();
}

bool ServoDevice::moving() {
  refresh(at::kMoving, 1);
  return byte(at::kMoving) != 0;
}

void ServoDevice::apply() {
  const auto unsigned16 = [this](std::uint16_t address) {
    return static_cast<std::uint16_t>(table_.get(address));
  };
  sim::ServoSetpoint& setpoint = plant_.setpoint(joint_);
  setpoint.torque_on = torque_on();
  setpoint.goal_count = static_cast<std::int32_t>(table_.get(at::kGoalPosition)) - homing();
  setpoint.p_gain = unsigned16(at::kPositionPGain);
  setpoint.i_gain = unsigned16(at::kPositionIGain);
  setpoint.d_gain = unsigned16(at::kPositionDGain);
  setpoint.pwm_limit = static_cast<std::uint16_t>(
      std::min(table_.get(at::kPwmLimit), std::abs(table_.get(at::kGoalPwm))));
  const bool time_based = (byte(at::kDriveMode) & dxl::kTimeBasedProfile) != 0;
  setpoint.profile_ms =
      time_based ? static_cast<std::uint32_t>(table_.get(at::kProfileVelocity)) : 0;
}

}  // namespace verp::bus
