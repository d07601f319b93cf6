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

/// A box, sphere, cylinder or capsule, and its size as Collision has it; false: another shape. Kind
/// is one of our enumerations, which all have these four.
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

/// The child of that name; none: there is none, nor of no parent.
sdf::ElementPtr inner(const sdf::ElementPtr& parent, const char* name);
/// Its value, where there is one: what libsdformat 12 has no classes for.
void read_leaf(const sdf::ElementPtr& parent, const char* name, double& value);

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
