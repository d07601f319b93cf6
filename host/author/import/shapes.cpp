#include "host/author/import/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "host/robot/model/leg.hpp"
#include "host/robot/model/mesh_file.hpp"

namespace verp::import {
namespace {

using model::Collision;
using model::Transform;
using model::Visual;

void add_round(std::vector<Vec3>& points, const Transform& pose, double radius_m, double half_m) {
  constexpr int kAround = 16;
  for (const double z : {-half_m, half_m}) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      points.push_back(pose * Vec3(radius_m * std::cos(angle), radius_m * std::sin(angle), z));
    }
  }
}

void add_ball(std::vector<Vec3>& points, const Vec3& centre, double radius_m) {
  for (int axis = 0; axis < 3; ++axis) {
    points.emplace_back(centre + radius_m * Vec3::Unit(axis));
    points.emplace_back(centre - radius_m * Vec3::Unit(axis));
  }
}

template <class Kind>
void add_solid(std::vector<Vec3>& points, Kind kind, const Vec3& size_m, const Transform& pose) {
  switch (kind) {
    case Kind::kBox:
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
        points.push_back(pose * Vec3(size_m.cwiseProduct(sign) / 2));
      }
      break;
    case Kind::kSphere:
      add_ball(points, pose.translation(), size_m.x());
      break;
    case Kind::kCylinder:
      add_round(points, pose, size_m.x(), size_m.z() / 2);
      break;
    default:  // a capsule
      add_ball(points, pose * Vec3(0, 0, size_m.z() / 2), size_m.x());
      add_ball(points, pose * Vec3(0, 0, -size_m.z() / 2), size_m.x());
  }
}

void add_seen(std::vector<Vec3>& points, const Visual& visual, const Transform& pose) {
  if (visual.shape != Visual::Shape::kMesh) {
    add_solid(points, visual.shape, visual.size_m, pose);
    return;
  }
  if (visual.mesh.empty()) return;
  try {
    const auto mesh = model::read_mesh_to_touch(visual.mesh, visual.size_m);
    for (const Vec3& corner : mesh->vertex_m) points.push_back(pose * corner);
  } catch (const std::runtime_error&) {  // as if it were missing: the page says so
  }
}

std::vector<Vec3> contacts_of(const model::Entity& entity, int node) {
  const auto& part = entity.nodes[static_cast<std::size_t>(node)];
  const Eigen::Translation3d at(model::node_origins(entity)[static_cast<std::size_t>(node)]);
  std::vector<Vec3> points;
  for (const Collision& each : part.collisions)
    add_solid(points, each.shape, each.size_m, at * each.pose);
  return points;
}

}  // namespace

std::vector<Vec3> points_of(const model::Entity& entity, int node) {
  std::vector<Vec3> points = contacts_of(entity, node);
  if (!points.empty()) return points;
  const auto& part = entity.nodes[static_cast<std::size_t>(node)];
  const Eigen::Translation3d at(model::node_origins(entity)[static_cast<std::size_t>(node)]);
  for (const Visual& each : part.visuals) add_seen(points, each, at * each.pose);
  return points;
}

Sole sole_of(const model::Entity& entity, int foot, double leg_m) {
  const std::vector<Vec3> points = points_of(entity, foot);
  Sole sole;
  double lowest = INFINITY;
  for (const Vec3& point : points) lowest = std::min(lowest, point.z());
  for (const double within_m : {0.004, 0.008, 0.016}) {
    for (const Vec3& point : points) {
      if (point.z() < lowest + within_m) sole.box.extend(Vec3(point.x(), point.y(), lowest));
    }
    const Vec3 size = sole.box.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(sole.box.sizes());
    if (size.x() > 0.15 * leg_m && size.y() > 0.08 * leg_m) return sole;
  }
  sole.measured = false;
  const Vec3 ankle = model::node_origins(entity)[static_cast<std::size_t>(foot)];
  const Vec3 middle(ankle.x() + 0.06 * leg_m, ankle.y(),
                    points.empty() ? ankle.z() - 0.17 * leg_m : lowest);
  sole.box.setEmpty();
  for (const double sign : {-1.0, 1.0})
    sole.box.extend(middle + sign * Vec3(0.27 * leg_m, 0.17 * leg_m, 0));
  return sole;
}

std::vector<std::string> reach_below(const model::Entity& entity, const std::vector<int>& feet,
                                     const std::vector<Sole>& soles) {
  constexpr double kLeast_m = 0.001;
  double floor_m = INFINITY;
  for (const Sole& sole : soles) floor_m = std::min(floor_m, sole.box.min().z());
  std::vector<std::string> found;
  for (int node = 0; node < static_cast<int>(entity.nodes.size()); ++node) {
    if (std::find(feet.begin(), feet.end(), node) != feet.end()) continue;
    const std::vector<Vec3> points = contacts_of(entity, node);
    const bool below = std::any_of(points.begin(), points.end(), [&](const Vec3& point) {
      return point.z() < floor_m - kLeast_m;
    });
    if (below) found.push_back(entity.nodes[static_cast<std::size_t>(node)].name);
  }
  return found;
}

}  // namespace verp::import
