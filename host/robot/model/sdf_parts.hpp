#pragma once
#include <ignition/math/Pose3.hh>
#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Collision.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Geometry.hh>
#include <sdf/SemanticPose.hh>
#include <sdf/Sphere.hh>
#include <string>

#include "host/robot/model/entity.hpp"

/// Conversions from libsdformat's types, and geometry checks without a file.
namespace verp::model {

Vec3 to_vector(const ignition::math::Vector3d& v);
Mat3 to_matrix(const ignition::math::Matrix3d& m);
Transform to_transform(const ignition::math::Pose3d& pose);

/// Seen from `from`. Throws std::runtime_error if libsdformat cannot resolve it; its own checks
/// exclude this.
Transform resolved(const sdf::SemanticPose& pose, const std::string& from);
inline Transform model_pose(const sdf::SemanticPose& pose) {
  return resolved(pose, "__model__");
}

/// Box, sphere, cylinder or capsule, sized as in Collision; false: another shape. Kind: an
/// enumeration with these values.
template <class Kind>
bool read_solid(const sdf::Geometry& geometry, Kind& kind, Vec3& size_m) {
  if (const auto* box = geometry.BoxShape()) {
    kind = Kind::kBox;
    size_m = to_vector(box->Size());
  } else if (const auto* sphere = geometry.SphereShape()) {
    kind = Kind::kSphere;
    size_m = {sphere->Radius(), 0, 0};
  } else if (const auto* cylinder = geometry.CylinderShape()) {
    kind = Kind::kCylinder;
    size_m = {cylinder->Radius(), 0, cylinder->Length()};
  } else if (const auto* capsule = geometry.CapsuleShape()) {
    kind = Kind::kCapsule;
    size_m = {capsule->Radius(), 0, capsule->Length()};
  } else {
    return false;
  }
  return true;
}

/// Child by name; null if it is missing or `parent` is null.
sdf::ElementPtr inner(const sdf::ElementPtr& parent, const char* name);
/// Reads its value, if it exists, where libsdformat 12 has no class.
void read_leaf(const sdf::ElementPtr& parent, const char* name, double& value);

/// False for meshes, planes, ellipsoids, which have no contacts.
bool read_shape(const sdf::Collision& sdf, Collision& collision);

double least_measure(const Collision& collision);

/// Error in mass and inertia, or empty. `extent_m`: the robot's diagonal, an upper bound of
/// gyration radii.
std::string implausible(const Node& node, double extent_m);

/// Extends the sole by a box's lower face (sole's frame) that lies in the sole's plane.
void extend_sole(Eigen::AlignedBox3d& sole, const Transform& box_sole, const Vec3& size_m);

}  // namespace verp::model
