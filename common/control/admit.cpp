#include "common/control/admit.hpp"

#include <bit>

#include "common/math/convert.hpp"
#include "common/model/tuning_ranges.hpp"
#include "common/safety/machine.hpp"

namespace verp {
namespace {

using namespace safety;

std::uint8_t older(std::uint8_t age, std::uint32_t periods = 1) {
  return static_cast<std::uint8_t>(periods < 255U - age ? age + periods : 255U);
}

bool flag(const Inputs& inputs, InputFlag which) {
  return (inputs.flags & which) != 0;
}

Vec3 in_body(const ImuParams& imu, const std::int16_t* count, float scale) {
  const Vec3 raw{math::to_float(std::int32_t{count[0]}), math::to_float(std::int32_t{count[1]}),
                 math::to_float(std::int32_t{count[2]})};
  Mat3 body_imu;
  body_imu << imu.body_imu[0], imu.body_imu[1], imu.body_imu[2], imu.body_imu[3], imu.body_imu[4],
      imu.body_imu[5], imu.body_imu[6], imu.body_imu[7], imu.body_imu[8];
  return scale * (body_imu * raw);
}

// Periods since the last tick: at least one, so that ages grow. A tick that runs backwards counts
// as a long silence.
std::uint32_t count_periods(const Inputs& inputs, AdmitState& state) {
  const std::uint32_t periods = inputs.tick - state.tick;
  state.tick = inputs.tick;
  return periods > 0 ? periods : 1;
}

// Periods of a silence, at least one: a servo read every tick is never stale.
int ticks(const Params& params, float duration_s) {
  const float period_s = static_cast<float>(params.period_us) * 1e-6F;
  const std::int32_t whole = math::to_int32(duration_s / period_s);
  return whole > 1 ? whole : 1;
}

bool is_frozen(const Inputs& inputs, AdmitState& state) {
  if (flag(inputs, kImuAssumed)) return false;
  std::uint32_t changed = 0;
  for (int i = 0; i < 3; ++i) {
    changed |= static_cast<std::uint32_t>(state.imu_count[i] ^ inputs.gyro_count[i]);
    changed |= static_cast<std::uint32_t>(state.imu_count[3 + i] ^ inputs.accel_count[i]);
    state.imu_count[i] = inputs.gyro_count[i];
    state.imu_count[3 + i] = inputs.accel_count[i];
  }
  if (changed != 0) {
    state.imu_alike = 0;
  } else if (state.imu_alike < kFrozenReadings) {
    ++state.imu_alike;
  }
  return state.imu_alike == kFrozenReadings;
}

// After `lost` periods the last tilt means nothing: the robot may have fallen.
void read_imu(const Params& params, const Inputs& inputs, bool doubted, int lost,
              std::uint32_t periods, AdmitState& state, AdmitOut& out) {
  state.imu_age = older(state.imu_age, periods);
  if (!flag(inputs, kImuFresh) || is_frozen(inputs, state) || doubted) return;
  out.imu_anew = state.imu_age > lost;
  state.imu_age = 0;
  out.imu_fresh = true;
  out.gyro_body_rad_s = in_body(params.imu, inputs.gyro_count, params.imu.gyro_rad_s_per_count);
  out.accel_body_m_s2 = in_body(params.imu, inputs.accel_count, params.imu.accel_m_s2_per_count);
}

std::uint8_t count_ages(const Params& params, std::uint32_t fresh, std::uint32_t periods,
                        AdmitState& state) {
  const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << params.joint_count) - 1U);
  // Fast path: the loop would be most of this stage's cost.
  if ((fresh & all) == all) {
    for (std::uint8_t& age : state.servo_age) age = 0;
    return 0;
  }
  std::uint8_t oldest = 0;
  for (int j = 0; j < params.joint_count; ++j) {
    std::uint8_t& age = state.servo_age[j];
    age = (fresh >> j & 1U) != 0 ? std::uint8_t{0} : older(age, periods);
    oldest = age > oldest ? age : oldest;
  }
  return oldest;
}

// The oldest servo decides: one silent knee is enough to fall. In skipped periods all devices were
// silent.
void watch_silence(const Params& params, const Tuning& tuning, const Inputs& inputs,
                   std::uint32_t doubted, int lost, std::uint32_t periods, AdmitState& state,
                   AdmitOut& out) {
  const std::uint8_t oldest = count_ages(params, inputs.fresh & ~doubted, periods, state);
  const int hold = ticks(params, tuning.safety.stale_hold_s);
  for (int j = 0; oldest >= hold && j < params.joint_count; ++j) {
    if (state.servo_age[j] < hold) continue;
    out.faults |= (doubted >> j & 1U) != 0 ? kFaultNotFollowing | 0U : kFaultServoSilent | 0U;
  }
  if (state.imu_age >= hold) out.faults |= kFaultImuSilent;
  const std::uint8_t skipped = older(0, periods - 1);
  int silent = oldest > state.imu_age ? oldest : state.imu_age;
  silent = silent > skipped ? silent : skipped;
  if (silent >= hold) out.conditions |= kStale;
  if (silent >= lost) out.conditions |= kLost;
  if (oldest < hold) out.conditions |= kServosKnown;
}

void count_alarm(std::uint32_t bit, bool bad, AdmitState& state) {
  static_assert(kAlarmReadings == 3, "two bits count to three");
  const std::uint32_t before = state.alarm_low;
  state.alarm_low &= ~bit;
  if (bad) {
    state.alarm_low |= ~state.alarm_high & bit;
    state.alarm_high |= before & bit;
  } else {
    state.alarm_high &= ~bit;
  }
}

std::uint32_t alarmed(const AdmitState& state) {
  return state.alarm_high & ~state.alarm_low;
}

void watch_power(const Params& params, const Tuning& tuning, const Inputs& inputs,
                 AdmitState& state, AdmitOut& out) {
  if (flag(inputs, kSlowFresh) && inputs.slow_joint < params.joint_count) {
    const std::uint32_t bit = 1U << inputs.slow_joint;
    const auto voltage_v = 0.1F * math::to_float(std::int32_t{inputs.slow_voltage_tenth_v});
    const auto temperature_c = math::to_float(std::int32_t{inputs.slow_temperature_c});
    std::uint32_t faults = 0;
    if (temperature_c > tuning.safety.temperature_high_c) faults |= kFaultTemperature;
    if (inputs.slow_error != 0) faults |= kFaultServoError;
    count_alarm(bit, faults != 0, state);
    if ((alarmed(state) & bit) != 0) out.faults |= faults;
    const bool low = voltage_v < tuning.safety.voltage_low_v;
    state.voltage_low = low ? older(state.voltage_low) : std::uint8_t{0};
    if (state.voltage_low >= kSupplyReadings) out.faults |= kFaultVoltage;
  }
  if (alarmed(state) != 0 || state.voltage_low >= kSupplyReadings) out.conditions |= kTrouble;
}

void take_command(const Params& params, const Tuning& tuning, const Inputs& inputs,
                  std::uint32_t periods, AdmitState& state, AdmitOut& out) {
  constexpr std::uint32_t kOldest = 0xFFFFFFFFU;
  if (flag(inputs, kCommandFresh)) {
    state.operator_age = 0;
  } else {
    state.operator_age =
        periods < kOldest - state.operator_age ? state.operator_age + periods : kOldest;
  }
  const float age_s =
      math::to_float(state.operator_age) * 1e-6F * static_cast<float>(params.period_us);
  if (age_s > tuning.safety.command_hold_s) {
    out.conditions |= kOperatorQuiet;
    out.faults |= kFaultOperatorQuiet;
  }
  if (age_s > tuning.safety.command_release_s) out.conditions |= kOperatorGone;
  const Command& command = inputs.command;
  switch (command.request) {
    case Request::kWalk:
      out.conditions |= kAskWalk | kAskStand;
      break;
    case Request::kStand:
    case Request::kGetUp:
      out.conditions |= kAskStand;
      break;
    default:
      out.conditions |= kAskRelax;
      break;
  }
  out.vx_m_s = 1e-4F * math::to_float(std::int32_t{command.vx_tenth_mm_s});
  out.vy_m_s = 1e-4F * math::to_float(std::int32_t{command.vy_tenth_mm_s});
  out.wz_rad_s = 1e-3F * math::to_float(std::int32_t{command.wz_mrad_s});
  out.head_pan_rad = 1e-3F * math::to_float(std::int32_t{command.head_pan_mrad});
  out.head_tilt_rad = 1e-3F * math::to_float(std::int32_t{command.head_tilt_mrad});
}

void write_parameter(const Inputs& inputs, Tuning& tuning, AdmitOut& out) {
  if (!flag(inputs, kParameterWrite)) return;
  const float value = std::bit_cast<float>(inputs.parameter_bits);
  if (in_range(inputs.parameter_id, value)) {
    set_tuning_value(tuning, inputs.parameter_id, value);
  } else {
    out.faults |= kNoteParameter;
  }
}

}  // namespace

void start(const Params& params, const Inputs& inputs, AdmitState& state) {
  for (int j = 0; j < params.joint_count; ++j) state.servo_age[j] = kNeverHeard;
  state.imu_age = kNeverHeard;
  state.tick = inputs.tick - 1;
  state.started = 1;
}

AdmitOut admit(const Params& params, AdmitState& state, Tuning& tuning, const Inputs& inputs,
               const Doubts& doubts) {
  AdmitOut out;
  const std::uint32_t periods = count_periods(inputs, state);
  write_parameter(inputs, tuning, out);
  const int lost = ticks(params, tuning.safety.stale_release_s);
  read_imu(params, inputs, doubts.imu, lost, periods, state, out);
  watch_silence(params, tuning, inputs, doubts.servos, lost, periods, state, out);
  watch_power(params, tuning, inputs, state, out);
  take_command(params, tuning, inputs, periods, state, out);
  if (flag(inputs, kEmergencyStop)) {
    out.conditions |= kEmergency;
    out.faults |= kFaultEmergency;
  }
  if (flag(inputs, kOverrun)) out.faults |= kNoteOverrun;
  return out;
}

}  // namespace verp
