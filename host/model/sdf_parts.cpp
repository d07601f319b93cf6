#include "host/model/sdf_parts.hpp"

#include <algorithm>
#include <cmath>
#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Geometry.hh>
#include <sdf/Sphere.hh>
#include <stdexcept>

#include "host/model/bounds.hpp"
#include "host/model/principal.hpp"

namespace verp::model {

Vec3 to_vector(const ignition::math::Vector3d& v) {
  return {v.X(), v.Y(), v.Z()};
}

Mat3 to_matrix(const ignition::math::Matrix3d& m) {
  Mat3 out;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      out(row, column) = m(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
    }
  }
  return out;
}

Transform to_transform(const ignition::math::Pose3d& pose) {
  Transform out = Transform::Identity();
  out.translation() = to_vector(pose.Pos());
  const auto& q = pose.Rot();
  out.linear() = Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).normalized().toRotationMatrix();
  return out;
}

Transform resolved(const sdf::SemanticPose& pose, const std::string& from) {
  ignition::math::Pose3d out;
  const sdf::Errors errors = pose.Resolve(out, from);
  if (!errors.empty()) throw std::runtime_error(errors.front().Message());
  return to_transform(out);
}

namespace {

/// <surface><friction><ode><mu> and its like, which libsdformat 12 has no classes for.
void read_surface(const sdf::ElementPtr& element, Collision& collision) {
  const auto child = [](const sdf::ElementPtr& parent, const char* name) -> sdf::ElementPtr {
    return parent && parent->HasElement(name) ? parent->GetElement(name) : nullptr;
  };
  const auto read = [&](const sdf::ElementPtr& parent, const char* name, double& value) {
    if (const auto leaf = child(parent, name)) value = leaf->Get<double>();
  };
  const auto surface = child(element, "surface");
  read(child(child(surface, "friction"), "ode"), "mu", collision.friction);
  const auto contact = child(child(surface, "contact"), "ode");
  read(contact, "kp", collision.stiffness_n_m);
  read(contact, "kd", collision.damping_n_s_m);
}

}  // namespace

bool read_shape(const sdf::Collision& sdf, Collision& collision) {
  const sdf::Geometry& geometry = *sdf.Geom();
  if (const auto* box = geometry.BoxShape()) {
    collision.shape = Collision::Shape::kBox;
    collision.size_m = to_vector(box->Size());
  } else if (const auto* sphere = geometry.SphereShape()) {
    collision.shape = Collision::Shape::kSphere;
    collision.size_m = {sphere->Radius(), 0, 0};
  } else if (const auto* cylinder = geometry.CylinderShape()) {
    collision.shape = Collision::Shape::kCylinder;
    collision.size_m = {cylinder->Radius(), 0, cylinder->Length()};
  } else if (const auto* capsule = geometry.CapsuleShape()) {
    collision.shape = Collision::Shape::kCapsule;
    collision.size_m = {capsule->Radius(), 0, capsule->Length()};
  } else {
    return false;
  }
  read_surface(sdf.Element(), collision);
  return true;
}

double least_measure(const Collision& collision) {
  const Vec3& size_m = collision.size_m;
  switch (collision.shape) {
    case Collision::Shape::kBox:
      return size_m.minCoeff();
    case Collision::Shape::kCylinder:
      return std::min(size_m.x(), size_m.z());
    default:  // a capsule may be a ball
      return size_m.x();
  }
}

std::string implausible(const Node& node, double extent_m) {
  if (!(node.mass_kg > 0) || !std::isfinite(node.mass_kg)) return "its mass is not positive";
  if (node.mass_kg < kLeastMass_kg) return "its mass is less than a milligram";
  const Vec3 moment = principal_moments(node.inertia_kg_m2);
  if (!(moment[0] > 0) || !moment.allFinite()) return "its inertia is not positive definite";
  if (moment[0] + moment[1] < moment[2] * (1 - 1e-3)) {
    return "its inertia breaks the triangle inequality: no body has such moments";
  }
  const double radius_m = std::sqrt(moment[2] / node.mass_kg);
  if (extent_m > 0 && radius_m > extent_m) {
    return "its radius of gyration is " + std::to_string(radius_m) +
           " m, more than the whole robot measures";
  }
  if (radius_m < kLeastGyration_m) {
    return "its radius of gyration is below 0.1 mm: no body is that dense";
  }
  return {};
}

void extend_sole(Eigen::AlignedBox3d& sole, const Transform& box_sole, const Vec3& size_m) {
  constexpr double kInPlane = 0.003;  // metres
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    const Vec3 point = box_sole * (size_m.cwiseProduct(sign) / 2);
    if (std::abs(point.z()) < kInPlane) sole.extend(point);
  }
}

}  // namespace verp::model
