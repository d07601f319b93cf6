#include "firmware/app/device_watch.hpp"

namespace verp::app {

DeviceWatch::DeviceWatch(const Params& params, RegisterImage& image)
    : params_(params), image_(image) {
  using table::DeviceKind;
  for (int j = 0; j < params.joint_count; ++j) {
    if (j < params.servo_count()) name(j, DeviceKind::kServo, params.joint[j].servo_id);
    image_.set(element(reg("joint_id"), j, 1), params.joint[j].servo_id);
  }
  name(table::kDeviceImu, DeviceKind::kImu, params.imu.device_id);
  for (int foot = 0; foot < kFeet; ++foot) {
    const std::uint8_t id = params.feet.device_id[foot];
    if (id != 0) name(table::kDeviceFoot + foot, DeviceKind::kFoot, id);
  }
  name(table::kDeviceBus, DeviceKind::kServoBus, 0);
  name(table::kDeviceLink, DeviceKind::kOperatorLink, 0);
}

void DeviceWatch::tick(const Inputs& inputs, const State& state, const Outputs& outputs) {
  const std::uint32_t ticks = ticking_ ? inputs.tick - tick_ : 1;
  elapsed_ = static_cast<std::uint16_t>(ticks < kOldest ? ticks : kOldest);
  tick_ = inputs.tick;
  ticking_ = true;
  const SafetyTuning& safety = state.tuning.safety;
  const Limits fast = limits(safety.stale_hold_s, safety.stale_release_s);
  for (int j = 0; j < params_.servo_count(); ++j) {
    const bool faulty = image_.get<std::uint8_t>(element(reg("joint_error"), j, 1)) != 0;
    const bool heard = (inputs.fresh >> j & 1u) != 0;
    sense(j, heard, faulty, fast);
    if (heard && stands_still(j, inputs, outputs) && !faulty) mark_stale(j);
  }
  const bool imu_heard = (inputs.flags & kImuFresh) != 0;
  sense(table::kDeviceImu, imu_heard, false, fast);
  if (imu_heard && state.admit.imu_alike >= kFrozenReadings) mark_stale(table::kDeviceImu);
  for (int foot = 0; foot < kFeet; ++foot) {
    if (params_.feet.device_id[foot] == 0) continue;
    sense(table::kDeviceFoot + foot, (inputs.flags & kFeetFresh) != 0, false, fast);
  }
  watch(table::kDeviceBus, inputs.fresh != 0 ? 1 : 0, false, fast);
  watch(table::kDeviceLink, packets_, false,
        limits(safety.command_hold_s, safety.command_release_s));
  packets_ = 0;
  count_rates();
}

void DeviceWatch::name(int row, table::DeviceKind kind, std::uint8_t id) {
  image_.set(element(reg("device_kind"), row, 1), kind);
  image_.set(element(reg("device_id"), row, 1), id);
  image_.set(element(reg("device_age"), row, 2), kOldest);
}

void DeviceWatch::errors(int row, std::uint32_t sum) {
  image_.set(element(reg("device_errors"), row, 4), sum);
}

DeviceWatch::Limits DeviceWatch::limits(float stale_s, float lost_s) const {
  const float per_s = 1e6F / static_cast<float>(params_.period_us);
  return {math::to_int32(stale_s * per_s), math::to_int32(lost_s * per_s)};
}

void DeviceWatch::sense(int row, bool fresh, bool faulty, const Limits& limits) {
  const std::uint16_t address = element(reg("device_errors"), row, 4);
  if (!fresh) image_.set(address, image_.get<std::uint32_t>(address) + 1);
  watch(row, fresh ? 1 : 0, faulty, limits);
}

bool DeviceWatch::stands_still(int j, const Inputs& inputs, const Outputs& outputs) {
  // Ticks for servo lag and the start from rest. Measured: a knee that was to step 3.7 degrees in
  // 3 ticks moved one tick later.
  constexpr std::uint8_t kPatience = 4;
  constexpr float kAway_rad = 0.0614F;  // 3.5 degrees: more than sag and backlash
  Still& still = still_[j];
  const bool holds = (outputs.torque_enable >> j & 1u) != 0;
  if (!holds || inputs.position_count[j] != still.position_count) {
    still = {inputs.position_count[j], outputs.goal_count[j], 0};
    return false;
  }
  const std::int64_t moved = std::int64_t{outputs.goal_count[j]} - still.goal_count;
  const std::int32_t away = math::to_int32(kAway_rad * math::abs(params_.joint[j].counts_per_rad));
  if (moved <= away && moved >= -away) {
    still.ticks = 0;
  } else if (still.ticks < kPatience) {
    ++still.ticks;
  }
  return still.ticks == kPatience;
}

void DeviceWatch::mark_stale(int row) {
  const std::uint16_t errors_at = element(reg("device_errors"), row, 4);
  image_.set(errors_at, image_.get<std::uint32_t>(errors_at) + 1);
  image_.set(element(reg("device_state"), row, 1), table::DeviceState::kStale);
}

void DeviceWatch::watch(int row, std::uint16_t reports, bool faulty, const Limits& limits) {
  using table::DeviceState;
  reports_[row] = static_cast<std::uint16_t>(reports_[row] + reports);
  const std::uint16_t age_at = element(reg("device_age"), row, 2);
  const std::uint16_t state_at = element(reg("device_state"), row, 1);
  const std::uint32_t older = std::uint32_t{image_.get<std::uint16_t>(age_at)} + elapsed_;
  const auto age = static_cast<std::uint16_t>(reports > 0 ? 0 : older < kOldest ? older : kOldest);
  const bool unseen = image_.get<DeviceState>(state_at) == DeviceState::kNeverSeen;
  image_.set(age_at, age);
  if (reports == 0 && unseen) return;
  image_.set(state_at, faulty                ? DeviceState::kFaulty
                       : age >= limits.lost  ? DeviceState::kLost
                       : age >= limits.stale ? DeviceState::kStale
                                             : DeviceState::kGood);
}

void DeviceWatch::count_rates() {
  window_us_ += elapsed_ * params_.period_us;
  if (window_us_ < 1'000'000) return;
  for (int row = 0; row < table::kDevices; ++row) {
    const std::uint64_t second = std::uint64_t{reports_[row]} * 1'000'000;
    image_.set(element(reg("device_rate"), row, 2),
               static_cast<std::uint16_t>((second + window_us_ / 2) / window_us_));
    reports_[row] = 0;
  }
  window_us_ = 0;
}

}  // namespace verp::app
