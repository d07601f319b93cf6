#pragma once
#include "host/robot/model/entity.hpp"

/// Eigen decompositions, once, because each compiles for seconds.
namespace verp::model {

/// Principal moments, smallest first. Not positive: an impossible inertia.
Vec3 principal_moments(const Mat3& inertia_kg_m2);

/// Roll, pitch, yaw about fixed axes, as in SDF.
Mat3 rotation_rpy(const Vec3& rpy_rad);

/// Shortest turn from z to `axis`, of any length; about -x for -z.
Eigen::Quaterniond turn_of_z(const Vec3& axis);

}  // namespace verp::model
