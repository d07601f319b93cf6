#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/plant.hpp"
#include "host/twin/sim/random.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::sim {

/// First order, like an IMU's filter or an ADC's RC.
class LowPass {
 public:
  double operator()(double value, double step_s);

 private:
  double value_ = 0;
  bool started_ = false;
};

/// As hal/chip/invensense reads it: bandwidth 23.9 Hz (InvenSense ICM-20648, DLPF 4), mean of one
/// control period.
/// An IMU that reports what is not so.
struct ImuLies {
  bool stuck = false;       ///< all counts stay, but for one bit that flickers
  bool gyro_stuck = false;  ///< the gyro's counts stay
  bool loose = false;       ///< it hangs upright and still, whatever the robot does
};

class ImuModel {
 public:
  /// mean_s: averaging time; 0: newest sample only. gyro_bias_rad_s adds to the drawn bias.
  ImuModel(const model::ImuSensor& sensor, double mean_s, bool noise, std::uint64_t seed,
           const Vec3& gyro_bias_rad_s = Vec3::Zero());

  /// Motion of the sensor's origin, world axes; up_world_m_s2: opposite to gravity. measurement()
  /// is one latency old, in whole steps; until then it is the first one.
  void sample(const Mat3& world_imu, const Vec3& angular_velocity_world_rad_s,
              const Vec3& acceleration_world_m_s2, const Vec3& up_world_m_s2, double step_s);
  const ImuMeasurement& measurement() const { return measurement_; }

  ImuLies lies;

 private:
  ImuMeasurement mean() const;
  ImuMeasurement told(const ImuMeasurement& measured);

  model::ImuSensor sensor_;
  double mean_s_;
  bool noise_;
  Random random_;
  Vec3 gyro_bias_rad_s_ = Vec3::Zero();
  Vec3 accel_bias_m_s2_ = Vec3::Zero();
  std::array<LowPass, 3> gyro_filter_;
  std::array<LowPass, 3> accel_filter_;
  std::deque<ImuMeasurement> samples_;     ///< of the last mean_s
  std::deque<ImuMeasurement> on_the_way_;  ///< within the latency
  ImuMeasurement measurement_;
};

class FootModel {
 public:
  FootModel(const model::Limb& leg, double newton_per_count, bool noise, Random random);

  void begin_step() { load_n_ = {}; }
  /// Shares a force bilinearly between the sole's corners, which keeps the centre of pressure.
  /// Points off the sole count at its edge.
  void add_load(const Vec3& point_sole_m, double force_n);
  void end_step(double step_s);
  const std::array<std::uint16_t, 4>& counts() const { return counts_; }

 private:
  Vec3 min_m_;
  Vec3 max_m_;
  double newton_per_count_;
  bool noise_;
  Random random_;
  std::array<double, 4> load_n_{};
  std::array<LowPass, 4> filter_;
  std::array<std::uint16_t, 4> counts_{};
};

}  // namespace verp::sim
