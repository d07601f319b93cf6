#pragma once
#include "host/robot/model/entity.hpp"

/// Eigen's decompositions that the PC needs in several places: each takes the compiler seconds, so
/// they stand here once.
namespace verp::model {

/// Of an inertia, smallest first. Not positive: no body has it.
Vec3 principal_moments(const Mat3& inertia_kg_m2);

/// Turned by roll, then pitch, then yaw about the fixed axes, as SDF has it.
Mat3 rotation_rpy(const Vec3& rpy_rad);

/// The shortest turn that brings z along `axis`, which need not be a unit vector; about -x where
/// that is -z. Eigen's own FromTwoVectors brings a decomposition that costs the compiler five
/// seconds.
Eigen::Quaterniond turn_of_z(const Vec3& axis);

}  // namespace verp::model
