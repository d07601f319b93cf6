#include "tests/replay/echo_plant.hpp"

#include "common/math/convert.hpp"
#include "common/math/scalar.hpp"
#include "common/model/tree.hpp"
#include "tests/replay/campaign.hpp"

namespace verp::replay {
namespace {

/// Triangle wave within +-height.
std::int32_t wave(std::uint32_t tick, std::uint32_t period, std::int32_t height) {
  const auto at = static_cast<std::int32_t>(tick % period);
  const auto half = static_cast<std::int32_t>(period / 2);
  return (at < half ? 2 * at - half : 3 * half - 2 * at) * height / half;
}

std::int16_t narrow(std::int32_t count) {
  return static_cast<std::int16_t>(math::clamp(count, -32768, 32767));
}

std::int32_t per_unit(float unit_per_count, float value) {
  return unit_per_count > 0.0F ? math::to_int32(value / unit_per_count) : 0;
}

}  // namespace

EchoPlant::EchoPlant(const Params& params, std::uint32_t seed) : params_(params), random_(seed) {
  for (int j = 0; j < kMaxJoints; ++j) {
    const JointParams& joint = params.joint[j];
    position_count_[j] = math::to_int32(joint.zero_count + joint.counts_per_rad * joint.sit_rad);
  }
  gyro_count_per_rad_s_ = per_unit(params.imu.gyro_rad_s_per_count, 1.0F);
  const std::int32_t gravity = per_unit(params.imu.accel_m_s2_per_count, math::kGravityMS2);
  for (int i = 0; i < 3; ++i) {
    rest_count_[i] = math::to_int32(params.imu.body_imu[6 + i] * math::to_float(gravity));
    nose_count_[i] = math::to_int32(-params.imu.body_imu[i] * math::to_float(gravity));
  }
  const JointParams& bent = params.joint[1];
  bent_count_ = math::to_int32(bent.counts_per_rad * (bent.upper_rad - bent.lower_rad + 0.5F));
  const float weight_n = model::total_mass(params) * math::kGravityMS2;
  foot_count_ = per_unit(params.feet.newton_per_count, weight_n) / 4;
}

void EchoPlant::sense(const Outputs& last, std::uint32_t events, Inputs& in) {
  move_joints(last, events, in);
  feel_motion(events, in);
  feel_ground(events, in);
  report_slowly(events, in);
  if ((events & kLate) != 0) in.flags |= kOverrun;
}

void EchoPlant::move_joints(const Outputs& last, std::uint32_t events, Inputs& in) {
  for (int j = 0; j < params_.joint_count; ++j) {
    if ((last.torque_enable >> j & 1U) != 0) position_count_[j] = last.goal_count[j];
    in.position_count[j] = position_count_[j] + random_.around_zero(2);
  }
  if ((events & kBent) != 0) in.position_count[1] += bent_count_;
  in.fresh = 0xFFFFFFFFU;
  if (random_.bits() % 32 == 0) in.fresh &= ~(1U << (random_.bits() % 32));
  if ((events & kSilentServo) != 0) in.fresh &= ~4U;
}

void EchoPlant::feel_motion(std::uint32_t events, Inputs& in) {
  const std::int32_t* accel = (events & kTip) != 0 ? nose_count_ : rest_count_;
  const std::int32_t one = gyro_count_per_rad_s_;
  for (int i = 0; i < 3; ++i) {
    in.accel_count[i] =
        narrow(accel[i] + wave(in.tick, 45, 40) + random_.around_zero(30) + (i == 0 ? 60 : 0));
    in.gyro_count[i] = narrow(wave(in.tick + 7, 45, one / 50) + random_.around_zero(one / 200 + 1));
  }
  // Angles and rates only have to come and go.
  const auto add = [&](int axis, std::int32_t rate) {
    in.gyro_count[axis] = narrow(in.gyro_count[axis] + rate);
  };
  for (int axis = 0; axis < 2; ++axis) {
    if ((events & kTip) != 0) add(axis, 3 * one);
    if ((events & kRight) != 0) add(axis, -3 * one);
  }
  if ((events & kTremble) != 0) add(0, in.tick % 2 == 0 ? one : -one);
  if ((events & kYawDrift) != 0) add(2, one);
  remember_motion((events & kFrozenImu) != 0, in);
  if ((events & kSilentImu) == 0 && random_.bits() % 64 != 0) in.flags |= kImuFresh;
}

void EchoPlant::remember_motion(bool frozen, Inputs& in) {
  for (int i = 0; i < 3; ++i) {
    if (frozen) {
      in.gyro_count[i] = gyro_count_[i];
      in.accel_count[i] = accel_count_[i];
    }
    gyro_count_[i] = in.gyro_count[i];
    accel_count_[i] = in.accel_count[i];
  }
}

void EchoPlant::feel_ground(std::uint32_t events, Inputs& in) {
  const bool in_air = (events & kFeetInAir) != 0;
  // The pressure moves round the sole, sometimes to an edge.
  const std::uint32_t turn = 4 * (in.tick / 20);
  const std::int32_t fore = wave(turn, 32, foot_count_ * 5 / 8);
  const std::int32_t aside = wave(turn + 8, 32, foot_count_ * 5 / 8);
  for (auto& foot : in.foot_count) {
    for (int corner = 0; corner < 4; ++corner) {
      const std::int32_t load =
          foot_count_ + (corner < 2 ? fore : -fore) + (corner % 2 == 0 ? aside : -aside);
      foot[corner] = in_air ? std::uint16_t{0} : static_cast<std::uint16_t>(load);
    }
  }
  if ((events & kFeetGone) == 0) in.flags |= kFeetFresh;
}

void EchoPlant::report_slowly(std::uint32_t events, Inputs& in) const {
  if (in.tick % 3 == 0) return;
  in.flags |= kSlowFresh;
  const std::uint32_t joints = params_.joint_count > 0 ? params_.joint_count : 1U;
  in.slow_joint = static_cast<std::uint8_t>(in.tick % joints);
  in.slow_temperature_c = (events & kHot) != 0 ? 90 : 40;
  in.slow_voltage_tenth_v = (events & kLowVoltage) != 0 ? 70 : 120;
  in.slow_error = (events & kServoAlarm) != 0 ? 4 : 0;
}

}  // namespace verp::replay
