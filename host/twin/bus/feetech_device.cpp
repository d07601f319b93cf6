#include "host/twin/bus/feetech_device.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/protocol/feetech.hpp"

namespace verp::bus {
namespace {

namespace mem = feetech::address;
namespace sense = feetech::sensor_block;

constexpr double kFullPwm = 885;  // the plant's units (ServoSetpoint)
constexpr double kPlantP = 128;
constexpr double kCurrentUnit_a = 0.0065;
constexpr std::int32_t kTurn = feetech::kCountsPerTurn;
constexpr std::uint16_t kMovingSpeed = 50;  // counts/s; an estimate

}  // namespace

std::vector<std::uint8_t> FeetechDevice::read(std::uint8_t address, std::uint8_t length) {
  refresh();
  std::vector<std::uint8_t> out(length, 0);
  for (unsigned i = 0; i < length; ++i) {
    const auto one = table_.bytes(static_cast<std::uint16_t>(address + i), 1);
    if (!one.empty()) out[i] = one[0];
  }
  return out;
}

void FeetechDevice::write(std::uint8_t address, std::span<const std::uint8_t> data) {
  for (std::size_t i = 0; i < data.size();) {
    const auto here = static_cast<std::uint16_t>(address + i);
    const Register* reg = table_.find(here);
    const std::size_t size = reg == nullptr ? 1 : reg->size;
    if (reg != nullptr && i + size <= data.size()) {
      const auto value = data.subspan(i, size);
      if (table_.check(here, value, false) == dxl::Error::kNone) {
        table_.store(here, value);
        if (here < mem::kTorqueEnable && byte(mem::kLock) == 0) kept_.store(here, value);
      }
    }
    i += size;
  }
  written();
}

void FeetechDevice::reg_write(std::uint8_t address, std::span<const std::uint8_t> data) {
  registered_at_ = address;
  registered_.assign(data.begin(), data.end());
  table_.set(mem::kRegistered, 1);
}

void FeetechDevice::action() {
  if (registered_.empty()) return;
  table_.set(mem::kRegistered, 0);
  write(registered_at_, std::exchange(registered_, {}));
}

void FeetechDevice::lose_power() {
  registered_.clear();
  table_.restore_initial(0, 0xFFFF);
  table_.copy(kept_, 0, mem::kTorqueEnable);
  table_.set(mem::kTorqueLimit, table_.get(mem::kMaxTorque));
  written();
}

FeetechServo::FeetechServo(const feetech_bus::Identity& identity, sim::Plant& plant, int joint)
    : FeetechDevice(feetech_bus::servo_registers(identity)), plant_(plant), joint_(joint) {
  apply();
}

std::int32_t FeetechServo::offset() const {
  return feetech::from_magnitude(word(mem::kOffset), feetech::kOffsetSign);
}

// lerobot, feetech.py: Present Position is the encoder's count less the offset.
std::uint16_t FeetechServo::shown(std::int32_t count) const {
  std::int32_t position = count - offset();
  if ((byte(mem::kPhase) & feetech::kWholeAngle) == 0) {
    position = (position % kTurn + kTurn) % kTurn;
  }
  return feetech::to_magnitude(position, feetech::kSign);
}

void FeetechServo::refresh() {
  const sim::ServoMeasurement measured = plant_.measure(joint_);
  const double speed_count_s = measured.velocity_rad_s * kTurn / (2 * std::numbers::pi);
  const auto magnitude = [](double value, unsigned sign) {
    return feetech::to_magnitude(static_cast<std::int32_t>(std::lround(value)), sign);
  };
  table_.set(mem::kPresentPosition, shown(measured.position_count));
  table_.set(mem::kPresentSpeed, magnitude(speed_count_s, feetech::kSign));
  table_.set(mem::kPresentLoad, magnitude(measured.duty * 1000, feetech::kLoadSign));
  table_.set(mem::kPresentVoltage, std::lround(measured.voltage_v * 10));
  table_.set(mem::kPresentTemperature, std::lround(measured.temperature_c));
  table_.set(mem::kPresentCurrent, magnitude(measured.current_a / kCurrentUnit_a, feetech::kSign));
  table_.set(mem::kMoving, std::abs(speed_count_s) > kMovingSpeed ? 1 : 0);
  watch_load(measured);
  watch_limits(measured);
}

std::uint8_t FeetechServo::status() {
  refresh();
  return byte(mem::kStatus);
}

void FeetechServo::watch_load(const sim::ServoMeasurement& measured) {
  const double load = std::abs(measured.duty) * 100;
  const std::uint64_t now_us = plant_.now_us();
  if (!torque_on() || load <= byte(mem::kOverloadTorque)) loaded_since_us_ = kNever_us;
  if (!torque_on()) overloaded_ = false;
  if (!torque_on() || load <= byte(mem::kOverloadTorque)) return;
  if (loaded_since_us_ == kNever_us) loaded_since_us_ = now_us;
  const bool guards = (byte(mem::kUnloading) & feetech::kOverloadStatus) != 0;
  const std::uint64_t patience_us = std::uint64_t{byte(mem::kProtectionTime)} * 10'000;
  if (!guards || overloaded_ || now_us - loaded_since_us_ < patience_us) return;
  overloaded_ = true;
  apply();
}

void FeetechServo::watch_limits(const sim::ServoMeasurement& measured) {
  unsigned status = overloaded_ ? unsigned{feetech::kOverloadStatus} : 0u;
  const double tenth_v = measured.voltage_v * 10;
  if (tenth_v > byte(mem::kMaxVoltage) || tenth_v < byte(mem::kMinVoltage)) {
    status |= feetech::kVoltageStatus;
  }
  if (measured.temperature_c > byte(mem::kMaxTemperature)) status |= feetech::kTemperatureStatus;
  table_.set(mem::kStatus, status);
  constexpr unsigned kLimp = feetech::kVoltageStatus | feetech::kTemperatureStatus;
  if ((status & byte(mem::kUnloading) & kLimp) == 0 || !torque_on()) return;
  table_.set(mem::kTorqueEnable, 0);
  apply();
}

void FeetechServo::make_middle() {
  const std::int32_t count = plant_.measure(joint_).position_count - kTurn / 2;
  table_.set(mem::kOffset, feetech::to_magnitude(count, feetech::kOffsetSign));
}

void FeetechServo::written() {
  const std::uint8_t torque = byte(mem::kTorqueEnable);
  if (torque == feetech::kMakeMiddle) make_middle();
  if (torque > 1) table_.set(mem::kTorqueEnable, torque_before_);
  torque_before_ = byte(mem::kTorqueEnable);
  if (!torque_on()) overloaded_ = false;
  apply();
}

void FeetechServo::apply() {
  sim::ServoSetpoint& setpoint = plant_.setpoint(joint_);
  const auto least = static_cast<std::int32_t>(word(mem::kMinPosition));
  const auto most = static_cast<std::int32_t>(word(mem::kMaxPosition));
  std::int32_t goal = feetech::from_magnitude(word(mem::kGoalPosition), feetech::kSign);
  if (least < most) goal = std::clamp(goal, least, most);
  setpoint.torque_on = torque_on() && byte(mem::kMode) == 0;
  setpoint.goal_count = goal + offset();
  setpoint.p_gain = static_cast<std::uint16_t>(
      std::lround(byte(mem::kPGain) * double{feetech::kDutyPerCount} * kFullPwm * kPlantP));
  setpoint.i_gain = setpoint.d_gain = 0;  // their units are published nowhere
  const double share =
      1e-3 * word(mem::kTorqueLimit) * (overloaded_ ? 0.01 * byte(mem::kProtectiveTorque) : 1.0);
  setpoint.pwm_limit = static_cast<std::uint16_t>(std::lround(kFullPwm * std::min(share, 1.0)));
  setpoint.profile_count_s =
      std::abs(feetech::from_magnitude(word(mem::kGoalSpeed), feetech::kSign));
  setpoint.accelerate_count_s2 = 100.0 * byte(mem::kAcceleration);
}

void FeetechSensor::put(unsigned word, std::uint16_t value) {
  table_.set(static_cast<std::uint16_t>(sense::kAddress + 2 * word), value);
}

void FeetechSensor::seal() {
  const auto data = table_.bytes(sense::kAddress, sense::kCheckAt);
  put(sense::kCheckAt / 2, sense::check_of(id(), data.data()));
}

void FeetechImu::refresh() {
  const sim::ImuMeasurement measured = plant_.imu();
  for (unsigned axis = 0; axis < 3; ++axis) {
    put(axis, static_cast<std::uint16_t>(measured.gyro_count[axis]));
    put(axis + 3, static_cast<std::uint16_t>(measured.accel_count[axis]));
  }
  seal();
}

void FeetechFoot::refresh() {
  const auto counts = plant_.foot_counts(foot_);
  for (unsigned i = 0; i < counts.size(); ++i) put(i, counts[i]);
  seal();
}

}  // namespace verp::bus
