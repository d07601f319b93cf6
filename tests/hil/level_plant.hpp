#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/math/scalar.hpp"
#include "common/model/params.hpp"
#include "common/model/tree.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::test {

/// On a stand: joints follow goals at top speed, the soles share the weight. The body shakes a
/// little, about level.
class LevelPlant final : public sim::Plant {
 public:
  explicit LevelPlant(const Params& params) : params_(params) {
    for (int j = 0; j < params.joint_count; ++j) {
      const JointParams& joint = params.joint[j];
      count_[index(j)] = joint.zero_count + joint.counts_per_rad * joint.sit_rad;
    }
    const float gravity = math::kGravityMS2 / params.imu.accel_m_s2_per_count;
    for (std::size_t i = 0; i < 3; ++i) {
      imu_.accel_count[i] =
          static_cast<std::int16_t>(std::lround(params.imu.body_imu[6 + i] * gravity));
    }
    const float weight_n = model::total_mass(params) * math::kGravityMS2;
    foot_count_ = static_cast<std::uint16_t>(weight_n / params.feet.newton_per_count / 8);
  }

  std::uint64_t now_us() const override { return now_us_; }
  void advance_to(std::uint64_t time_us) override {
    if (time_us <= now_us_) return;
    const float passed_s = 1e-6F * static_cast<float>(time_us - now_us_);
    now_us_ = time_us;
    for (int j = 0; j < params_.joint_count; ++j) {
      if (!setpoint_[index(j)].torque_on) continue;
      const JointParams& joint = params_.joint[j];
      const float most = std::abs(joint.counts_per_rad) * joint.velocity_limit_rad_s * passed_s;
      const float goal = static_cast<float>(setpoint_[index(j)].goal_count);
      count_[index(j)] = std::clamp(goal, count_[index(j)] - most, count_[index(j)] + most);
    }
  }
  sim::ServoSetpoint& setpoint(int joint) override { return setpoint_[index(joint)]; }
  sim::ServoMeasurement measure(int joint) override {
    sim::ServoMeasurement measured;
    measured.position_count = static_cast<std::int32_t>(std::lround(count_[index(joint)]));
    return measured;
  }
  sim::ImuMeasurement imu() override {
    sim::ImuMeasurement measured = imu_;
    const auto by = static_cast<std::int16_t>(now_us_ / params_.period_us % 2 == 0 ? 3 : -3);
    for (std::size_t i = 0; i < 3; ++i) {
      measured.gyro_count[i] = by;
      measured.accel_count[i] = static_cast<std::int16_t>(imu_.accel_count[i] + by);
    }
    return measured;
  }
  std::array<std::uint16_t, 4> foot_counts(int) override {
    return {foot_count_, foot_count_, foot_count_, foot_count_};
  }

 private:
  static std::size_t index(int joint) { return static_cast<std::size_t>(joint); }
  const Params& params_;
  std::uint64_t now_us_ = 0;
  std::array<float, kMaxJoints> count_{};
  std::array<sim::ServoSetpoint, kMaxJoints> setpoint_{};
  sim::ImuMeasurement imu_;
  std::uint16_t foot_count_ = 0;
};

/// Makes an encoder or the IMU repeat itself, heats a servo, bends a joint, sags the supply.
class SickPlant final : public sim::Plant {
 public:
  explicit SickPlant(sim::Plant& plant) : plant_(plant) {}
  void freeze(int joint) {
    frozen_ = plant_.measure(joint);
    frozen_joint_ = joint;
  }
  void freeze_imu() {
    frozen_imu_ = plant_.imu();
    imu_frozen_ = true;
  }
  void heat(int joint, double temperature_c) {
    hot_joint_ = joint;
    temperature_c_ = temperature_c;
  }
  void sag_to(double voltage_v) { voltage_v_ = voltage_v; }
  /// Puts the joint `count` counts from where its servo would have it.
  void bend(int joint, std::int32_t count) {
    bent_joint_ = joint;
    bent_count_ = count;
  }
  void cure() {
    bent_joint_ = -1;
    frozen_joint_ = hot_joint_ = -1;
    imu_frozen_ = false;
    voltage_v_ = 0;
  }

  std::uint64_t now_us() const override { return plant_.now_us(); }
  void advance_to(std::uint64_t time_us) override { plant_.advance_to(time_us); }
  sim::ServoSetpoint& setpoint(int joint) override { return plant_.setpoint(joint); }
  sim::ServoMeasurement measure(int joint) override {
    sim::ServoMeasurement measured = joint == frozen_joint_ ? frozen_ : plant_.measure(joint);
    if (joint == bent_joint_) measured.position_count += bent_count_;
    if (joint == hot_joint_) measured.temperature_c = temperature_c_;
    if (voltage_v_ > 0) measured.voltage_v = voltage_v_;
    return measured;
  }
  sim::ImuMeasurement imu() override { return imu_frozen_ ? frozen_imu_ : plant_.imu(); }
  std::array<std::uint16_t, 4> foot_counts(int foot) override { return plant_.foot_counts(foot); }

 private:
  sim::Plant& plant_;
  sim::ServoMeasurement frozen_;
  sim::ImuMeasurement frozen_imu_;
  int frozen_joint_ = -1;
  int hot_joint_ = -1;
  int bent_joint_ = -1;
  std::int32_t bent_count_ = 0;
  double temperature_c_ = 25;
  double voltage_v_ = 0;  ///< for all servos; 0: the plant's
  bool imu_frozen_ = false;
};

}  // namespace verp::test
