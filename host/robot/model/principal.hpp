#pragma once
#include "host/robot/model/entity.hpp"

/// Eigen decompositions used in several places. They are here once, because each costs the compiler
/// seconds.
namespace verp::model {

/// Of an inertia, smallest first. Not positive: the inertia is impossible.
Vec3 principal_moments(const Mat3& inertia_kg_m2);

/// Rotation by roll, then pitch, then yaw about the fixed axes, as in SDF.
Mat3 rotation_rpy(const Vec3& rpy_rad);

/// Shortest rotation from z to `axis`, which need not be a unit vector; about -x if `axis` is -z.
/// Eigen's FromTwoVectors costs the compiler five seconds for a decomposition.
Eigen::Quaterniond turn_of_z(const Vec3& axis);

}  // namespace verp::model
