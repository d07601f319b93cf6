#pragma once
#include <array>
#include <cstdint>

#include "common/model/params.hpp"
#include "common/protocol/control_table.hpp"
#include "common/protocol/feetech_table.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::test {

/// Joints jump to their goals; samples are recorded.
class FakePlant final : public sim::Plant {
 public:
  std::uint64_t now_us() const override { return now_us_; }
  void advance_to(std::uint64_t time_us) override {
    went_back = went_back || time_us < now_us_;
    now_us_ = time_us;
    for (std::size_t j = 0; j < setpoints.size(); ++j) {
      if (setpoints[j].torque_on && !blocked[j])
        measured[j].position_count = setpoints[j].goal_count;
    }
  }
  sim::ServoSetpoint& setpoint(int joint) override {
    return setpoints[static_cast<std::size_t>(joint)];
  }
  sim::ServoMeasurement measure(int joint) override {
    sampled_us[static_cast<std::size_t>(joint)] = now_us_;
    return measured[static_cast<std::size_t>(joint)];
  }
  sim::ServoRating rating(int) const override { return rated; }
  sim::ImuMeasurement imu() override { return motion; }
  std::array<std::uint16_t, 4> foot_counts(int foot) override {
    const auto base = static_cast<std::uint16_t>(100 * (foot + 1));
    return {base, static_cast<std::uint16_t>(base + 1), static_cast<std::uint16_t>(base + 2),
            static_cast<std::uint16_t>(base + 3)};
  }

  std::array<sim::ServoSetpoint, kMaxJoints> setpoints{};
  std::array<sim::ServoMeasurement, kMaxJoints> measured{};
  std::array<std::uint64_t, kMaxJoints> sampled_us{};
  sim::ServoRating rated{};
  sim::ImuMeasurement motion{{1, -2, 3}, {-4, 5, 4096}};
  std::array<bool, kMaxJoints> blocked{};
  bool went_back = false;

 private:
  std::uint64_t now_us_ = 0;
};

inline constexpr std::uint8_t kImuId = 100;
inline constexpr std::uint8_t kLeftFootId = 101;
inline constexpr std::uint8_t kRightFootId = 102;

/// XM430-W210 servos with ids from 1, an IMU and two feet, 2 Mbaud, 10 ms.
inline Params bus_params(int joints, bool fast = true) {
  Params params;
  params.joint_count = static_cast<std::uint8_t>(joints);
  params.servo[0] = {.model_number = dxl::kModelXm430W210,
                     .position_p_gain = 3500,
                     .position_i_gain = 10,
                     .position_d_gain = 20,
                     .profile_ms = 10,
                     .fast_sync_read = static_cast<std::uint16_t>(fast ? 1 : 0)};
  for (int j = 0; j < joints; ++j) {
    params.joint[j].servo_id = static_cast<std::uint8_t>(j + 1);
    params.joint[j].parent = static_cast<std::uint8_t>(j);
    params.joint[j].lower_rad = -3.1F;
    params.joint[j].upper_rad = 3.1F;
    params.joint[j].counts_per_rad = 651.9F;
    params.joint[j].zero_count = 2048;
  }
  params.imu.device_id = kImuId;
  params.feet.device_id[0] = kLeftFootId;
  params.feet.device_id[1] = kRightFootId;
  return params;
}

inline Params feetech_params(int joints) {
  Params params = bus_params(joints);
  params.bus_protocol = BusProtocol::kFeetech;
  params.baud = 1'000'000;
  params.servo[0] = {.model_number = feetech::kModelSts3215,
                     .position_p_gain = 97,
                     .position_i_gain = 3,
                     .position_d_gain = 32};
  for (int j = 0; j < joints; ++j) params.joint[j].velocity_limit_rad_s = 6;
  return params;
}

}  // namespace verp::test
