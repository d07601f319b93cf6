#pragma once
#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "tests/support/random_inputs.hpp"

namespace verp::replay {

/// Without physics: joints are at the previous tick's goals, sensors follow waveforms of small
/// integers.
class EchoPlant {
 public:
  EchoPlant(const Params& params, std::uint32_t seed);

  void sense(const Outputs& last, std::uint32_t events, Inputs& in);

 private:
  void move_joints(const Outputs& last, std::uint32_t events, Inputs& in);
  void feel_motion(std::uint32_t events, Inputs& in);
  void remember_motion(bool frozen, Inputs& in);
  void feel_ground(std::uint32_t events, Inputs& in);
  void report_slowly(std::uint32_t events, Inputs& in) const;

  const Params& params_;
  test::SmallRandom random_;
  std::int32_t position_count_[kMaxJoints] = {};
  std::int32_t gyro_count_per_rad_s_;
  std::int32_t rest_count_[3];                             ///< accelerometer, standing
  std::int32_t nose_count_[3];                             ///< lying on the nose
  std::int32_t bent_count_;                                ///< moves any joint beyond its limits
  std::int32_t foot_count_;                                ///< one corner's share on one foot
  std::int16_t gyro_count_[3] = {}, accel_count_[3] = {};  ///< last readings
};

}  // namespace verp::replay
