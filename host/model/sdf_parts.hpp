#pragma once
#include <ignition/math/Pose3.hh>
#include <sdf/Collision.hh>
#include <sdf/SemanticPose.hh>
#include <string>

#include "host/model/entity.hpp"

/// Small conversions from libsdformat's types, and the geometry checks that need no file.
namespace verp::model {

Vec3 to_vector(const ignition::math::Vector3d& v);
Mat3 to_matrix(const ignition::math::Matrix3d& m);
Transform to_transform(const ignition::math::Pose3d& pose);

/// A pose seen from frame `from`. Throws LoadError-free std::runtime_error when libsdformat cannot
/// resolve it, which its own checks exclude.
Transform resolved(const sdf::SemanticPose& pose, const std::string& from);
inline Transform model_pose(const sdf::SemanticPose& pose) {
  return resolved(pose, "__model__");
}

/// Shape, size and surface; false for shapes that contacts cannot use (meshes, planes, ellipsoids).
bool read_shape(const sdf::Collision& sdf, Collision& collision);

/// The smallest extent of a shape: edge, radius or length.
double least_measure(const Collision& collision);

/// Empty, or what is wrong with a node's mass and inertia. `extent_m`: the robot's diagonal, which
/// no link's radius of gyration can exceed.
std::string implausible(const Node& node, double extent_m);

/// Widens `sole` by the lower face of a box (given in the sole's frame) if that face lies in the
/// sole's plane.
void extend_sole(Eigen::AlignedBox3d& sole, const Transform& box_sole, const Vec3& size_m);

}  // namespace verp::model
