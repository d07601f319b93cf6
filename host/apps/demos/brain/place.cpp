#include "host/apps/demos/brain/place.hpp"

#include <Eigen/LU>
#include <cmath>

namespace verp::brain {
namespace {

// Uncertainty per metre walked: twice that of odometry in the twin, because a real floor may be
// worse.
constexpr double kSlip = 0.06;            // m per m
constexpr double kSlipTurn_rad_m = 0.03;  // rad per m
constexpr double kGate = 9.2;             // chi square, two degrees of freedom, 99 %

}  // namespace

Estimate::Estimate(const Pose& at, double within_m, double within_rad) : pose_(at) {
  covariance_ = Eigen::Vector3d(within_m * within_m, within_m * within_m, within_rad * within_rad)
                    .asDiagonal();
}

void Estimate::move(const Pose& odometry) {
  if (begun_) {
    const Pose by = into(odometry_, odometry);
    const Point step = turned(by.at_m, pose_.yaw_rad);
    Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
    f(0, 2) = -step.y;
    f(1, 2) = step.x;
    const double way_m = length(by.at_m);
    const double turn_m = 0.1 * std::abs(by.yaw_rad);  // soles slip in turns on the spot, too
    const double far = kSlip * kSlip * (way_m + turn_m),
                 turn = kSlipTurn_rad_m * kSlipTurn_rad_m * (way_m + turn_m);
    covariance_ = f * covariance_ * f.transpose();
    covariance_.diagonal() += Eigen::Vector3d(far, far, turn);
    pose_ = out_of(pose_, by);
  }
  odometry_ = odometry;
  begun_ = true;
}

bool Estimate::see(Point seen, Point known, double within_m) {
  const Point expected = into(pose_, known);
  const Point off = seen - expected;
  const double c = std::cos(pose_.yaw_rad), s = std::sin(pose_.yaw_rad);
  Eigen::Matrix<double, 2, 3> h;
  h << -c, -s, expected.y, s, -c, -expected.x;
  const Eigen::Matrix2d sum =
      h * covariance_ * h.transpose() + within_m * within_m * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d error(off.x, off.y);
  const Eigen::Matrix2d inverse = sum.inverse();
  if (error.dot(inverse * error) > kGate) return false;
  const Eigen::Matrix<double, 3, 2> gain = covariance_ * h.transpose() * inverse;
  const Eigen::Vector3d by = gain * error;
  pose_.at_m = pose_.at_m + Point{by(0), by(1)};
  pose_.yaw_rad = wrapped(pose_.yaw_rad + by(2));
  covariance_ = (Eigen::Matrix3d::Identity() - gain * h) * covariance_;
  covariance_ = 0.5 * (covariance_ + covariance_.transpose().eval());
  return true;
}

double Estimate::within_m() const {
  return std::sqrt(0.5 * (covariance_(0, 0) + covariance_(1, 1)));
}

}  // namespace verp::brain
