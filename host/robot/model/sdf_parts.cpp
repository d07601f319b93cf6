#include "host/robot/model/sdf_parts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "host/robot/model/bounds.hpp"
#include "host/robot/model/principal.hpp"

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

sdf::ElementPtr inner(const sdf::ElementPtr& parent, const char* name) {
  return parent && parent->HasElement(name) ? parent->GetElement(name) : nullptr;
}

void read_leaf(const sdf::ElementPtr& parent, const char* name, double& value) {
  if (const auto leaf = inner(parent, name)) value = leaf->Get<double>();
}

bool read_shape(const sdf::Collision& sdf, Collision& collision) {
  if (!read_solid(*sdf.Geom(), collision.shape, collision.size_m)) return false;
  const auto surface = inner(sdf.Element(), "surface");
  read_leaf(inner(inner(surface, "friction"), "ode"), "mu", collision.friction);
  const auto contact = inner(inner(surface, "contact"), "ode");
  read_leaf(contact, "kp", collision.stiffness_n_m);
  read_leaf(contact, "kd", collision.damping_n_s_m);
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
