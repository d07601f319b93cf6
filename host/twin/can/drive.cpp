#include "host/twin/can/drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/protocol/canopen/frame.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/control_table.hpp"

namespace verp::can {
namespace {

using canopen::Abort;
using canopen::Address;
using canopen::ErrorCode;
using canopen::cia402::State;
using canopen::cia402::Trigger;
namespace cia402 = canopen::cia402;
namespace object = canopen::cia402::object;

// Factory limits of a serial servo (e-Manual, XM430-W210).
constexpr double kHottest_c = 80;
constexpr double kStands_rad_s = 0.1;  ///< slower than this counts as stopped

constexpr int kPerMille = 1000;
constexpr std::uint32_t kWork_ms = 1;  ///< the ramp's steps

/// Wraps as the 32-bit position counter does.
std::int32_t around(std::int32_t count, std::int64_t offset) {
  return static_cast<std::int32_t>(count + offset);
}

std::int32_t rounded(double count) {
  return static_cast<std::int32_t>(std::lround(count));
}

/// A slow ramp: 1 rad/s, reached in 0.1 s.
ProfileObjects commissioned(double counts_per_rad) {
  const auto counts = [counts_per_rad](double rad) {
    return static_cast<std::uint32_t>(std::max(std::lround(counts_per_rad * rad), 1L));
  };
  ProfileObjects objects;
  objects.velocity = counts(1);
  objects.acceleration = objects.deceleration = counts(10);
  return objects;
}

}  // namespace

DriveApplication::DriveApplication(sim::Plant& plant, int joint, const DriveSetup& setup)
    : plant_(plant), joint_(joint), setup_(setup), rating_(plant.rating(joint)) {
  restart();
}

Abort DriveApplication::find(Address at, canopen::Entry& entry) const {
  if (at == canopen::plan::kTelemetry) {
    entry = {true, false, 4, 4, 4};
    return Abort::kNone;
  }
  if (at.index == kGains) {
    if (at.subindex > 3) return Abort::kNoSubindex;
    entry = at.subindex == 0 ? canopen::Entry{true, false, 1, 1, 1}
                             : canopen::Entry{true, true, 2, 2, 2};
    return Abort::kNone;
  }
  if (at.index == canopen::plan::kTelemetry.index) return Abort::kNoSubindex;
  if (is_profile_object(at.index)) return find_profile(at, entry);
  return cia402::find_object(at, entry);
}

Abort DriveApplication::read(Address at, std::uint32_t, std::uint8_t* buffer, std::uint32_t size) {
  refresh();
  if (at == canopen::plan::kTelemetry || at.index == kGains) {
    canopen::put_le(buffer, get(at, static_cast<std::uint8_t>(8 * size)), size);
    return Abort::kNone;
  }
  if (is_profile_object(at.index)) {
    read_profile(profile_, at, buffer);
    return Abort::kNone;
  }
  return cia402::read_object(objects_, at, buffer);
}

Abort DriveApplication::write(Address at, const std::uint8_t* data, std::uint32_t size) {
  if (const Abort refused = write_own(at, data, size); refused != Abort::kNone) return refused;
  if (at == object::kTargetPosition) target_written_ = true;
  if (at == object::kControlword) control(objects_.controlword);
  if (at == object::kHomeOffset) positioning_.stand(around(goal_, -zero_count()));
  settle();
  return Abort::kNone;
}

Abort DriveApplication::write_own(Address at, const std::uint8_t* data, std::uint32_t size) {
  if (at.index == kGains) {
    const std::uint64_t value = canopen::get_le(data, size);
    if (value > kMostGain) return Abort::kValueTooHigh;
    gains_[at.subindex - 1] = static_cast<std::uint16_t>(value);
    return Abort::kNone;
  }
  if (is_profile_object(at.index)) return write_profile(profile_, at, data);
  if (at == object::kMode) return change_mode(static_cast<std::int8_t>(data[0]));
  return cia402::write_object(objects_, at, data);
}

Abort DriveApplication::change_mode(std::int8_t mode) {
  if (!has_mode(mode)) return Abort::kValueRange;
  if (mode == objects_.mode) return Abort::kNone;
  const bool positions = objects_.mode == kModeProfilePosition || objects_.mode == kModeHoming;
  if (positions) target_written_ = false;  // it was a set-point, or has another zero
  objects_.mode = mode;
  hold(goal_);
  return Abort::kNone;
}

bool DriveApplication::operates(std::int8_t mode) const {
  return drive_.state() == State::kOperationEnabled && objects_.mode == mode;
}

Abort DriveApplication::mappable(Address at, std::uint8_t bits, bool receive) const {
  if (at == canopen::plan::kTelemetry) {
    return !receive && bits == 32 ? Abort::kNone : Abort::kNotMappable;
  }
  if (at.index == kGains) return Abort::kNotMappable;
  if (is_profile_object(at.index)) return profile_mappable(at, bits);
  return cia402::check_mappable(at, bits, receive);
}

std::uint64_t DriveApplication::get(Address at, std::uint8_t) {
  refresh();
  if (at == canopen::plan::kTelemetry) {
    const sim::ServoMeasurement measured = plant_.measure(joint_);
    return canopen::plan::Telemetry{
        static_cast<std::uint16_t>(std::lround(measured.voltage_v * 10)),
        static_cast<std::uint8_t>(std::clamp(std::lround(measured.temperature_c), 0L, 255L)),
        hardware_errors_}
        .value();
  }
  if (at.index == kGains) return at.subindex == 0 ? 3u : gains_[at.subindex - 1];
  std::uint8_t bytes[8] = {};
  if (is_profile_object(at.index)) {
    read_profile(profile_, at, bytes);
  } else {
    cia402::read_object(objects_, at, bytes);
  }
  return canopen::get_le(bytes, 8);
}

void DriveApplication::put(Address at, std::uint8_t bits, std::uint64_t value) {
  std::uint8_t bytes[8] = {};
  canopen::put_le(bytes, value, 8);
  write(at, bytes, bits / 8u);
}

void DriveApplication::restart() {
  objects_ = cia402::DriveObjects{};
  objects_.supported_modes = kDriveModes;
  profile_ = commissioned(setup_.counts_per_rad);
  homing_ = Homing{};
  objects_.encoder_increments =
      static_cast<std::uint32_t>(std::lround(setup_.counts_per_rad * 2 * std::numbers::pi));
  objects_.rated_current_ma = static_cast<std::uint32_t>(std::lround(rating_.current_a * 1000));
  objects_.rated_torque_mn_m = static_cast<std::uint32_t>(std::lround(rating_.torque_n_m * 1000));
  drive_ = cia402::Drive{};
  following_.reset();
  gains_[0] = setup_.p_gain;
  gains_[1] = setup_.i_gain;
  gains_[2] = setup_.d_gain;
  hardware_errors_ = 0;
  home_count_ = 0;
  last_word_ = 0;
  target_written_ = limited_ = following_error_ = warned_ = false;
  state_ = State::kNotReady;
  drive_.event(Trigger::kInitialised, objects_.quick_stop_option);
  settle();
}

DriveApplication::Settings DriveApplication::settings() const {
  return {objects_, profile_, {gains_[0], gains_[1], gains_[2]}, home_count_};
}

// Restores no commands: a drive does nothing by itself after boot.
void DriveApplication::restore(const Settings& settings) {
  for (std::size_t i = 0; i < cia402::kDriveRowCount; ++i) {
    const cia402::ObjectRow& row = cia402::kDriveRows[i];
    const bool command = row.at == object::kControlword || row.at == object::kTargetPosition;
    if (command || row.access != cia402::ObjectAccess::kWrite) continue;
    std::uint8_t bytes[8] = {};
    cia402::read_object(settings.objects, row.at, bytes);
    cia402::write_object(objects_, row.at, bytes);
  }
  objects_.mode = settings.objects.mode;
  profile_ = settings.profile;
  home_count_ = settings.home_count;
  std::copy(std::begin(settings.gains), std::end(settings.gains), gains_);
  settle();
}

void DriveApplication::power_off() {
  plant_.setpoint(joint_).torque_on = false;
}

bool DriveApplication::connection_lost() {
  const auto option = static_cast<cia402::AbortConnection>(objects_.abort_connection);
  const bool is_fault = option == cia402::AbortConnection::kFault;
  if (is_fault && !drive_.powered()) return false;
  const bool taken = drive_.connection_lost(option, objects_.quick_stop_option) != 0;
  settle();
  return taken && is_fault;
}

void DriveApplication::control(std::uint16_t word) {
  constexpr std::uint8_t kFaultReset = 15;
  const Controlword both{word, std::exchange(last_word_, word)};
  const bool operated = drive_.state() == State::kOperationEnabled;
  if (drive_.control(word, objects_.quick_stop_option) == kFaultReset) {
    hardware_errors_ = 0;
    following_error_ = false;
  }
  if (operated && operates(kModeProfilePosition)) positioning_.control(both);
  if (operated && operates(kModeHoming) && homing_.control(both, profile_.homing_method)) {
    come_home();
  }
}

void DriveApplication::settle() {
  objects_.mode_display = objects_.mode;
  if (drive_.state() == State::kFaultReactionActive) {
    drive_.event(Trigger::kFaultReactionDone, objects_.quick_stop_option);
  }
  if (drive_.state() == State::kQuickStopActive && objects_.quick_stop_option == 0) {
    drive_.event(Trigger::kQuickStopDone, objects_.quick_stop_option);
  }
  const State now = drive_.state();
  if (now != state_) {
    const bool stops = now == State::kQuickStopActive;
    if (stops || now == State::kOperationEnabled) hold(plant_.measure(joint_).position_count);
    if (stops || now == State::kSwitchOnDisabled || now == State::kFault) target_written_ = false;
    if (now != State::kOperationEnabled) following_.reset();
    state_ = now;
  }
  apply();
}

DriveNews DriveApplication::work(std::uint64_t now_us) {
  const DriveNews news = watch(now_us);
  if (drive_.state() == State::kQuickStopActive &&
      std::abs(plant_.measure(joint_).velocity_rad_s) < kStands_rad_s) {
    drive_.event(Trigger::kQuickStopDone, objects_.quick_stop_option);
  }
  if (operates(kModeProfilePosition)) {
    positioning_.advance(objects_, profile_, now_us);
  }
  settle();
  return news;
}

// In mode 1 against the ramp.
bool DriveApplication::follows_badly(std::uint64_t now_us) {
  if (operates(cia402::kModeCyclicPosition)) return following_.update(objects_, now_us);
  if (!operates(kModeProfilePosition)) return false;
  cia402::DriveObjects watched = objects_;
  watched.target_position = rounded(positioning_.goal());
  return following_.update(watched, now_us);
}

DriveNews DriveApplication::watch(std::uint64_t now_us) {
  refresh();
  const sim::ServoMeasurement measured = plant_.measure(joint_);
  const bool hot = measured.temperature_c > kHottest_c;
  if (!hot) drive_.clear_fault();  // without torque there is no following error
  if (hot && drive_.state() != State::kFault) {
    return fault(ErrorCode::kOverTemperature, canopen::kErrorTemperature, dxl::kOverheatingError);
  }
  if (follows_badly(now_us)) {
    following_error_ = true;
    return fault(ErrorCode::kFollowingError, canopen::kErrorProfile, 0);
  }
  const bool low = measured.voltage_v < rating_.least_v();
  if (!low && measured.voltage_v <= rating_.most_v()) {
    warned_ = false;
    return {};
  }
  hardware_errors_ |= dxl::kInputVoltageError;
  if (warned_) return {};
  warned_ = true;
  return {low ? ErrorCode::kUnderVoltage : ErrorCode::kOverVoltage, canopen::kErrorVoltage, true};
}

DriveNews DriveApplication::fault(ErrorCode code, std::uint8_t error_register,
                                  std::uint8_t error_bit) {
  hardware_errors_ |= error_bit;
  drive_.event(Trigger::kFault, objects_.quick_stop_option);
  return {code, error_register, true};
}

// Current over rated current; if that is unknown, the duty, as in the serial servos' Present Load.
double DriveApplication::share(const sim::ServoMeasurement& measured) const {
  return rating_.current_a > 0 ? measured.current_a / rating_.current_a : measured.duty;
}

void DriveApplication::hold(std::int32_t count) {
  held_count_ = count;
  positioning_.stand(around(count, -zero_count()));
}

void DriveApplication::come_home() {
  home_count_ = plant_.measure(joint_).position_count;
  target_written_ = false;
  following_.reset();
  hold(goal_);
}

void DriveApplication::refresh() {
  const sim::ServoMeasurement measured = plant_.measure(joint_);
  objects_.actual_position = around(measured.position_count, -zero_count());
  objects_.actual_velocity =
      static_cast<std::int32_t>(std::lround(measured.velocity_rad_s * setup_.counts_per_rad));
  objects_.actual_torque = static_cast<std::int16_t>(std::lround(share(measured) * kPerMille));
  objects_.dc_link_mv = static_cast<std::uint32_t>(std::lround(measured.voltage_v * 1000));
  objects_.statusword = drive_.statusword(status_bits());
}

std::uint16_t DriveApplication::status_bits() const {
  std::uint16_t bits = cia402::kVoltageEnabled | cia402::kRemote;
  if (operates(cia402::kModeCyclicPosition)) bits |= cia402::kFollowsCommand;
  if (operates(kModeProfilePosition)) bits |= positioning_.status();
  if (operates(kModeHoming)) bits |= homing_.status();
  if (limited_) bits |= cia402::kInternalLimit;
  if (following_error_) bits |= cia402::kFollowingError;
  if (hardware_errors_ != 0) bits |= cia402::kWarning;
  return bits;
}

std::int32_t DriveApplication::goal_count() {
  limited_ = false;
  if (operates(kModeProfilePosition)) {
    limited_ = positioning_.limited();
    return around(rounded(positioning_.goal()), zero_count());
  }
  if (!operates(cia402::kModeCyclicPosition) || !target_written_) return held_count_;
  const std::int32_t target =
      std::min(std::max(objects_.target_position, objects_.min_position), objects_.max_position);
  limited_ = target != objects_.target_position;
  return around(target, zero_count());
}

void DriveApplication::apply() {
  const std::uint32_t period_us =
      cia402::interpolation_period_us(objects_.period_value, objects_.period_exponent);
  const int torque = std::min<int>(objects_.max_torque, kPerMille);
  sim::ServoSetpoint& setpoint = plant_.setpoint(joint_);
  setpoint.torque_on = drive_.powered();
  setpoint.goal_count = goal_ = goal_count();
  setpoint.p_gain = gains_[0];
  setpoint.i_gain = gains_[1];
  setpoint.d_gain = gains_[2];
  setpoint.pwm_limit = static_cast<std::uint16_t>(dxl::kFullPwm * torque / kPerMille);
  setpoint.profile_ms = drive_.state() == State::kQuickStopActive ? 0
                        : operates(kModeProfilePosition)          ? kWork_ms
                                                                  : (period_us + 500) / 1000;
}

}  // namespace verp::can
