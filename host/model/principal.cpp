#include "host/model/principal.hpp"

#include <Eigen/Eigenvalues>

namespace verp::model {

Vec3 principal_moments(const Mat3& inertia_kg_m2) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(inertia_kg_m2, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::Quaterniond turn_of_z(const Vec3& axis) {
  return Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis);
}

}  // namespace verp::model
