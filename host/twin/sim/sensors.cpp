#include "host/twin/sim/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace verp::sim {
namespace {

constexpr double kBandwidthHz = 23.9;
/// One sigma: a quarter percent of a 10 N force-sensing resistor's span; an estimate.
constexpr double kFootNoiseN = 0.025;

template <class Int>
Int to_count(double value, double per_count) {
  if (!(per_count > 0)) return 0;
  constexpr double kLow = std::numeric_limits<Int>::min();
  constexpr double kHigh = std::numeric_limits<Int>::max();
  return static_cast<Int>(std::clamp(std::round(value / per_count), kLow, kHigh));
}

Vec3 normal3(Random& random, double sigma) {
  const double x = random.normal();
  const double y = random.normal();
  const double z = random.normal();
  return sigma * Vec3(x, y, z);
}

}  // namespace

double LowPass::operator()(double value, double step_s) {
  if (!started_) value_ = value;
  started_ = true;
  const double turn = 2 * std::numbers::pi * kBandwidthHz * step_s;
  value_ += (value - value_) * turn / (1 + turn);
  return value_;
}

ImuModel::ImuModel(const model::ImuSensor& sensor, double mean_s, bool noise, std::uint64_t seed,
                   const Vec3& gyro_bias_rad_s)
    : sensor_(sensor),
      mean_s_(mean_s),
      noise_(noise),
      random_(seed, Draw::kImuNoise),
      gyro_bias_rad_s_(gyro_bias_rad_s) {
  if (!noise) return;
  Random bias(seed, Draw::kImuBias);
  gyro_bias_rad_s_ += normal3(bias, sensor.gyro_bias_rad_s);
  accel_bias_m_s2_ = normal3(bias, sensor.accel_bias_m_s2);
}

void ImuModel::sample(const Mat3& world_imu, const Vec3& angular_velocity_world_rad_s,
                      const Vec3& acceleration_world_m_s2, const Vec3& up_world_m_s2,
                      double step_s) {
  Vec3 gyro = world_imu.transpose() * angular_velocity_world_rad_s;
  Vec3 accel = world_imu.transpose() * (acceleration_world_m_s2 + up_world_m_s2);
  gyro += gyro_bias_rad_s_;
  accel += accel_bias_m_s2_;
  if (noise_) {  // white, before the filter
    const double band_rthz = std::sqrt(0.5 / step_s);
    gyro += normal3(random_, sensor_.gyro_noise_rad_s_rthz * band_rthz);
    accel += normal3(random_, sensor_.accel_noise_m_s2_rthz * band_rthz);
  }
  ImuMeasurement now;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    gyro[axis] = gyro_filter_[i](gyro[axis], step_s);
    accel[axis] = accel_filter_[i](accel[axis], step_s);
    now.gyro_count[i] = to_count<std::int16_t>(gyro[axis], sensor_.gyro_rad_s_per_count);
    now.accel_count[i] = to_count<std::int16_t>(accel[axis], sensor_.accel_m_s2_per_count);
  }
  samples_.push_back(now);
  const auto together = static_cast<std::size_t>(std::lround(mean_s_ / step_s));
  while (samples_.size() > std::max<std::size_t>(together, 1)) samples_.pop_front();
  on_the_way_.push_back(mean());
  const auto late_by = static_cast<std::size_t>(std::lround(sensor_.latency_s / step_s));
  while (on_the_way_.size() > late_by + 1) on_the_way_.pop_front();
  measurement_ = told(on_the_way_.front());
}

ImuMeasurement ImuModel::told(const ImuMeasurement& measured) {
  ImuMeasurement told = lies.stuck ? measurement_ : measured;
  if (lies.stuck) told.accel_count[0] = static_cast<std::int16_t>(told.accel_count[0] ^ 1);
  if (lies.gyro_stuck) told.gyro_count = measurement_.gyro_count;
  return told;
}

ImuMeasurement ImuModel::mean() const {
  ImuMeasurement mean;
  const auto of = [this](auto count, std::size_t axis) {
    double sum = 0;
    for (const ImuMeasurement& sample : samples_) sum += (sample.*count)[axis];
    return static_cast<std::int16_t>(std::lround(sum / static_cast<double>(samples_.size())));
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    mean.gyro_count[axis] = of(&ImuMeasurement::gyro_count, axis);
    mean.accel_count[axis] = of(&ImuMeasurement::accel_count, axis);
  }
  return mean;
}

FootModel::FootModel(const model::Limb& leg, double newton_per_count, bool noise, Random random)
    : min_m_(leg.sole_min_m),
      max_m_(leg.sole_max_m),
      newton_per_count_(newton_per_count),
      noise_(noise),
      random_(random) {}

void FootModel::add_load(const Vec3& point_sole_m, double force_n) {
  const auto share = [](double at, double low, double high) {
    return high > low ? std::clamp((at - low) / (high - low), 0.0, 1.0) : 0.5;
  };
  const double front = share(point_sole_m.x(), min_m_.x(), max_m_.x());
  const double left = share(point_sole_m.y(), min_m_.y(), max_m_.y());
  load_n_[0] += force_n * front * left;
  load_n_[1] += force_n * front * (1 - left);
  load_n_[2] += force_n * (1 - front) * left;
  load_n_[3] += force_n * (1 - front) * (1 - left);
}

void FootModel::end_step(double step_s) {
  for (std::size_t i = 0; i < load_n_.size(); ++i) {
    double load = filter_[i](load_n_[i], step_s);
    if (noise_) load += kFootNoiseN * random_.normal();
    counts_[i] = to_count<std::uint16_t>(load, newton_per_count_);
  }
}

}  // namespace verp::sim
