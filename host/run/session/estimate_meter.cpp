#include "host/run/session/estimate_meter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace verp::session {
namespace {

using sim::Vec2;
using sim::Vec3;

constexpr double kDegrees_per_rad = 180 / std::numbers::pi;

Vec3 exact(const Xyz& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

Vec2 along(double heading_rad, const Vec2& v) {
  return Eigen::Rotation2Dd(-heading_rad) * v;
}

/// Both sides' mean, or the supporting side; a user's controller may output any `stance`.
template <class Of>
Vec2 under_load(std::uint8_t stance, Of&& of) {
  if (stance >= gait::kBoth) return (of(0) + of(1)).template head<2>() / 2;
  return of(stance).template head<2>();
}

/// From the supporting sole to the true DCM.
Vec2 real_dcm_m(const sim::Truth& truth, std::uint8_t stance) {
  const auto sole = [&](int side) {
    return truth.foot[static_cast<std::size_t>(side)].centroid_world_m;
  };
  const double ground_m =
      stance >= gait::kBoth ? (sole(0).z() + sole(1).z()) / 2 : sole(stance).z();
  const double height_m = std::max(truth.com_world_m.z() - ground_m, 0.05);
  const double omega = std::sqrt(static_cast<double>(math::kGravityMS2) / height_m);
  return truth.com_world_m.head<2>() + truth.com_velocity_world_m_s.head<2>() / omega -
         under_load(stance, sole);
}

}  // namespace

void EstimateMeter::tick(const State& state, const Outputs& outputs, const sim::Truth& truth,
                         const Vec3& up_world) {
  const std::uint8_t stance_before = std::exchange(stance_, outputs.stance);
  const bool walks = outputs.gait_phase != static_cast<std::uint8_t>(gait::Phase::kIdle);
  if (!walks || truth.fallen || !truth.foot[0].present || !truth.foot[1].present) return;
  const balance::EstimatorState& estimate = state.estimator;
  if (estimate.begun == 0) return;
  ++ticks_;

  const Vec3 up_body = truth.body_world.linear().transpose() * up_world;
  const Vec3 off = exact(estimate.up_body).normalized().cross(up_body);  // small: as angles
  const double tilt_rad = std::asin(std::clamp(off.norm(), 0.0, 1.0));
  roll_rad2_ += off.x() * off.x();
  pitch_rad2_ += off.y() * off.y();
  attitude_rad2_ += tilt_rad * tilt_rad;
  attitude_worst_rad_ = std::max(attitude_worst_rad_, tilt_rad);

  const double believed_rad = static_cast<double>(state.attitude.heading_rad);
  const Vec3 velocity = exact(estimate.com_velocity_m_s), real = truth.com_velocity_world_m_s;
  const double off_m_s = std::hypot(
      (along(believed_rad, velocity.head<2>()) - along(truth.yaw_rad, real.head<2>())).norm(),
      velocity.z() - real.z());
  velocity_m2_s2_ += off_m_s * off_m_s;
  velocity_worst_m_s_ = std::max(velocity_worst_m_s_, off_m_s);

  const gait::Xy dcm = balance::dcm_m(estimate);
  const Vec2 from_sole_m = Vec2(static_cast<double>(dcm.x), static_cast<double>(dcm.y)) -
                           under_load(outputs.stance, [&](int side) {
                             return Vec3(balance::sole_m(estimate, side).cast<double>());
                           });
  dcm_m2_ +=
      (along(believed_rad, from_sole_m) - along(truth.yaw_rad, real_dcm_m(truth, outputs.stance)))
          .squaredNorm();

  follow({exact(estimate.body_m).head<2>(), believed_rad},
         {truth.body_world.translation().head<2>(), truth.yaw_rad},
         outputs.stance == gait::kLeft && stance_before != gait::kLeft);
}

void EstimateMeter::follow(const Place& believed, const Place& real, bool cycle_begins) {
  if (!real_first_) {
    believed_first_ = believed;
    real_first_ = real;
    last_mark_m_ = real.at_m;
  }
  believed_ = believed;
  real_ = real;
  if (!cycle_begins) return;
  way_m_ += (real.at_m - last_mark_m_).norm();
  last_mark_m_ = real.at_m;
}

EstimateErrors EstimateMeter::result() const {
  EstimateErrors out;
  if (ticks_ == 0) return out;
  const auto mean_root = [&](double sum) { return std::sqrt(sum / static_cast<double>(ticks_)); };
  out.ticks = ticks_;
  out.attitude_rms_deg = kDegrees_per_rad * mean_root(attitude_rad2_);
  out.roll_rms_deg = kDegrees_per_rad * mean_root(roll_rad2_);
  out.pitch_rms_deg = kDegrees_per_rad * mean_root(pitch_rad2_);
  out.attitude_worst_deg = kDegrees_per_rad * attitude_worst_rad_;
  out.com_velocity_rms_m_s = mean_root(velocity_m2_s2_);
  out.com_velocity_worst_m_s = velocity_worst_m_s_;
  out.dcm_rms_m = mean_root(dcm_m2_);
  const auto gone = [](const Place& first, const Place& last) {
    return along(first.heading_rad, last.at_m - first.at_m);
  };
  out.odometry_off_m = (gone(*believed_first_, believed_) - gone(*real_first_, real_)).norm();
  const double turned_rad = (believed_.heading_rad - believed_first_->heading_rad) -
                            (real_.heading_rad - real_first_->heading_rad);
  out.odometry_turned_off_deg = kDegrees_per_rad * std::remainder(turned_rad, 2 * std::numbers::pi);
  out.way_m = way_m_ + (real_.at_m - last_mark_m_).norm();
  return out;
}

}  // namespace verp::session
