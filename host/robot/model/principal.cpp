#include "host/robot/model/principal.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace verp::model {

Vec3 principal_moments(const Mat3& inertia_kg_m2) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(inertia_kg_m2, Eigen::EigenvaluesOnly).eigenvalues();
}

Mat3 rotation_rpy(const Vec3& rpy_rad) {
  return (Eigen::AngleAxisd(rpy_rad.z(), Vec3::UnitZ()) *
          Eigen::AngleAxisd(rpy_rad.y(), Vec3::UnitY()) *
          Eigen::AngleAxisd(rpy_rad.x(), Vec3::UnitX()))
      .toRotationMatrix();
}

Eigen::Quaterniond turn_of_z(const Vec3& axis) {
  const Vec3 z = Vec3::UnitZ(), to = axis.normalized(), turn = z.cross(to);
  const double along = to.dot(z);
  Eigen::Quaterniond q;
  if (along < -1 + Eigen::NumTraits<double>::dummy_precision()) {  // half a turn
    const Vec3 about = turn.norm() > 0 ? turn.normalized() : Vec3(-Vec3::UnitX());
    const double half = (1 + std::max(along, -1.0)) / 2;
    q.vec() = about * std::sqrt(1 - half);
    q.w() = std::sqrt(half);
    return q;
  }
  const double scale = std::sqrt((1 + along) * 2);
  q.vec() = turn * (1 / scale);
  q.w() = scale / 2;
  return q;
}

}  // namespace verp::model
