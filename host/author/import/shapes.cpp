#include "host/author/import/shapes.hpp"

#include <Eigen/Eigenvalues>
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

using Turn = Eigen::Matrix3d;  ///< of a sole: its third column is up

Turn turned(double pitch_rad, double roll_rad) {
  return (Eigen::AngleAxisd(pitch_rad, Vec3::UnitY()) * Eigen::AngleAxisd(roll_rad, Vec3::UnitX()))
      .toRotationMatrix();
}

/// Those within `within_m` of a floor so turned that touches them from below.
std::vector<Vec3> lowest_of(const std::vector<Vec3>& points, const Turn& turn, double within_m) {
  double lowest = INFINITY;
  for (const Vec3& point : points) lowest = std::min(lowest, turn.col(2).dot(point));
  std::vector<Vec3> low;
  for (const Vec3& point : points) {
    if (turn.col(2).dot(point) < lowest + within_m) low.push_back(point);
  }
  return low;
}

Sole sole_on(const std::vector<Vec3>& points, const Turn& turn, double within_m) {
  Eigen::AlignedBox3d box;
  for (const Vec3& point : lowest_of(points, turn, within_m)) box.extend(turn.transpose() * point);
  if (box.isEmpty()) return {};
  Sole sole{.length_m = box.sizes().x(), .width_m = box.sizes().y()};
  sole.pose.linear() = turn;
  sole.pose.translation() = turn * Vec3(box.center().x(), box.center().y(), box.min().z());
  return sole;
}

bool is_sole(const Sole& sole, double leg_m, double narrowest) {
  return sole.length_m > 0.15 * leg_m && sole.width_m > narrowest * leg_m;
}

/// Along the plane through these points.
Turn along_plane(const std::vector<Vec3>& points) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& point : points) middle += point / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& point : points) spread += (point - middle) * (point - middle).transpose();
  Vec3 up = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  if (up.z() < 0) up = -up;
  return turned(std::atan2(up.x(), up.z()), -std::asin(std::clamp(up.y(), -1.0, 1.0)));
}

/// The pitch and then the roll, in steps of a degree, that make the largest sole; then the plane of
/// its points, if it is within three degrees: any plane fits a narrow strip.
Sole tilted_sole(const std::vector<Vec3>& points) {
  constexpr double kDegree_rad = std::numbers::pi / 180, kWithin_m = 0.004;
  constexpr int kMostPitch = 30, kMostRoll = 20;
  Sole best = sole_on(points, Turn::Identity(), kWithin_m);
  const auto area = [](const Sole& sole) { return sole.length_m * sole.width_m; };
  const auto look = [&](const Turn& turn) {
    const Sole sole = sole_on(points, turn, kWithin_m);
    if (area(sole) > area(best)) best = sole;
  };
  for (int degree = -kMostPitch; degree <= kMostPitch; ++degree)
    look(turned(degree * kDegree_rad, 0));
  const Vec3 ahead = best.pose.linear().col(0);
  for (int degree = -kMostRoll; degree <= kMostRoll; ++degree)
    look(turned(std::asin(-ahead.z()), degree * kDegree_rad));
  const std::vector<Vec3> low = lowest_of(points, best.pose.linear(), kWithin_m);
  if (low.size() < 3) return best;
  const Sole fitted = sole_on(points, along_plane(low), kWithin_m);
  const double cosine = fitted.pose.linear().col(2).dot(best.pose.linear().col(2));
  const bool is_near = cosine > std::cos(3 * kDegree_rad);
  return is_near && area(fitted) > 0.9 * area(best) ? fitted : best;
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
  for (const double narrowest : {0.08, 0.03}) {
    for (const double within_m : {0.004, 0.008, 0.016}) {
      const Sole sole = sole_on(points, Turn::Identity(), within_m);
      if (is_sole(sole, leg_m, narrowest)) return sole;
    }
    const Sole tilted = tilted_sole(points);
    if (is_sole(tilted, leg_m, narrowest)) return tilted;
  }
  Sole guess;
  guess.measured = false;
  guess.length_m = 0.54 * leg_m;
  guess.width_m = 0.34 * leg_m;
  const Vec3 ankle = model::node_origins(entity)[static_cast<std::size_t>(foot)];
  double lowest = points.empty() ? ankle.z() - 0.17 * leg_m : INFINITY;
  for (const Vec3& point : points) lowest = std::min(lowest, point.z());
  guess.pose.translation() = Vec3(ankle.x() + 0.06 * leg_m, ankle.y(), lowest);
  return guess;
}

std::vector<std::string> reach_below(const model::Entity& entity, const std::vector<int>& feet,
                                     const std::vector<Sole>& soles) {
  constexpr double kLeast_m = 0.001;
  double floor_m = INFINITY;
  for (const Sole& sole : soles) floor_m = std::min(floor_m, sole.pose.translation().z());
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
