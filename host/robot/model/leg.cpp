#include "host/robot/model/leg.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace verp::model {
namespace {

struct Line {
  Vec3 point, axis;
};

double distance(const Line& line, const Vec3& point) {
  const Vec3 d = point - line.point;
  return (d - d.dot(line.axis) * line.axis).norm();
}

/// The line's point that is nearest to `point`.
Vec3 foot_of(const Line& line, const Vec3& point) {
  return line.point + line.axis.dot(point - line.point) * line.axis;
}

/// The point with the least squares of the distances to the lines.
Vec3 meeting_point(const std::vector<Line>& lines) {
  Mat3 sum = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const Line& line : lines) {
    const Mat3 across = Mat3::Identity() - line.axis * line.axis.transpose();
    sum += across;
    right += across * line.point;
  }
  return sum.completeOrthogonalDecomposition().solve(right);
}

double largest_distance(const std::vector<Line>& lines, const Vec3& point) {
  double largest = 0;
  for (const Line& line : lines) largest = std::max(largest, distance(line, point));
  return largest;
}

/// Angle about +y that turns straight down onto this vector of the sagittal plane.
double pitch_of(const Vec3& v) {
  return std::atan2(-v.x(), -v.z());
}

Vec3 in_sagittal_plane(Vec3 v) {
  v.y() = 0;
  return v;
}

void shift_frame(Entity& entity, int node, const Vec3& shift) {
  entity.joints[static_cast<std::size_t>(node - 1)].origin_m += shift;
  Node& moved = entity.nodes[static_cast<std::size_t>(node)];
  moved.com_m -= shift;
  for (Collision& collision : moved.collisions) collision.pose.translation() -= shift;
  for (Visual& visual : moved.visuals) visual.pose.translation() -= shift;
  for (Joint& child : entity.joints) {
    if (child.parent == node) child.origin_m -= shift;
  }
  for (Limb& limb : entity.limbs) {
    if (limb.joints.back() == node - 1) limb.tip.translation() -= shift;
  }
  for (LaserSensor& laser : entity.lasers) {
    if (laser.node == node) laser.pose.translation() -= shift;
  }
  for (CameraSensor& camera : entity.cameras) {
    if (camera.node == node) camera.pose.translation() -= shift;
  }
  for (ForceTorqueSensor& sensor : entity.force_torques) {
    if (sensor.node == node) sensor.pose.translation() -= shift;
  }
  for (TruthSensor& sensor : entity.truths) {
    if (sensor.node == node) sensor.pose.translation() -= shift;
  }
  for (OtherSensor& sensor : entity.sensors) {
    if (sensor.node == node) sensor.pose.translation() -= shift;
  }
}

}  // namespace

const Limb* find_limb(const Entity& entity, const std::string& name) {
  const auto limb = std::find_if(entity.limbs.begin(), entity.limbs.end(),
                                 [&](const Limb& each) { return each.name == name; });
  return limb == entity.limbs.end() ? nullptr : &*limb;
}

std::vector<Vec3> node_origins(const Entity& entity) {
  std::vector<Vec3> origins(entity.nodes.size(), Vec3::Zero());
  for (const std::size_t j : outward(entity)) {
    const Joint& joint = entity.joints[j];
    origins[j + 1] = origins[static_cast<std::size_t>(joint.parent)] + joint.origin_m;
  }
  return origins;
}

std::optional<std::array<int, 6>> slots_of(const Entity& entity, const Limb& leg) {
  constexpr double kMostly = 0.7;
  const std::vector<int>& joints = leg.joints;
  const auto axis = [&](int j) { return entity.joints[static_cast<std::size_t>(j)].axis; };
  std::array<int, 6> slots;
  slots.fill(-1);
  if (joints.size() == slots.size()) {
    std::copy(joints.begin(), joints.end(), slots.begin());
    return slots;
  }
  const bool yaws = std::any_of(joints.begin(), joints.end(),
                                [&](int j) { return std::abs(axis(j).z()) > kMostly; });
  const bool rolls = std::abs(axis(joints.back()).x()) > kMostly;
  const std::size_t wanted = 4 + (yaws ? 1 : 0) + (rolls ? 1 : 0);
  if (joints.size() != wanted || wanted == slots.size()) return std::nullopt;
  std::copy(joints.begin(), joints.end(), slots.begin() + (yaws ? 0 : 1));
  return slots;
}

LegGeometry classify_leg(const Entity& entity, const Limb& leg) {
  LegGeometry g;
  g.joint = *slots_of(entity, leg);
  const std::vector<Vec3> origins = node_origins(entity);
  const std::array<Vec3, 6> wanted = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY(),
                                      Vec3::UnitY(), Vec3::UnitY(), Vec3::UnitX()};
  std::array<Line, 6> line;
  for (std::size_t k = 0; k < 6; ++k) {
    if (g.joint[k] < 0) {
      g.direction[k] = 1;
      g.reason = k == 0 ? "it has no hip yaw" : "it has no ankle roll";
      continue;
    }
    const auto j = static_cast<std::size_t>(g.joint[k]);
    line[k] = {origins[j + 1], entity.joints[j].axis};
    const double along = line[k].axis.dot(wanted[k]);
    g.direction[k] = along < 0 ? -1 : 1;
    if (std::abs(along) < 1 - 1e-6 && g.reason.empty()) {
      g.reason = "joint '" + entity.joints[j].name + "' does not turn about the body's " +
                 std::string(1, "zxyyyx"[k]) + " axis";
    }
  }
  const std::vector<Line> hip(line.begin() + (g.joint[0] < 0 ? 1 : 0), line.begin() + 3);
  const std::vector<Line> ankle(line.begin() + 4, line.end() - (g.joint[5] < 0 ? 1 : 0));
  g.hip_m = meeting_point(hip);
  // Along a single axis, the ankle's centre is beside the hip.
  g.ankle_m = ankle.size() > 1 ? meeting_point(ankle) : foot_of(ankle[0], g.hip_m);
  g.residual_m = std::max({largest_distance(hip, g.hip_m), largest_distance(ankle, g.ankle_m),
                           std::abs(g.hip_m.y() - g.ankle_m.y())});
  if (g.reason.empty() && g.residual_m > kAxesMeet) g.reason = "the hip or ankle axes do not meet";
  const Vec3 thigh = in_sagittal_plane(line[3].point - g.hip_m);
  const Vec3 shank = in_sagittal_plane(g.ankle_m - line[3].point);
  g.thigh_m = thigh.norm();
  g.shank_m = shank.norm();
  // The foot is parallel to the body at zero: the pitches sum to zero.
  g.offset_rad = {0, 0, pitch_of(thigh), pitch_of(shank) - pitch_of(thigh), -pitch_of(shank), 0};
  g.closed_form = g.reason.empty();
  return g;
}

void gather_leg_frames(Entity& entity) {
  for (const char* const name : {"left_leg", "right_leg"}) {
    const Limb* const leg = find_limb(entity, name);
    if (!leg) continue;
    const LegGeometry g = classify_leg(entity, *leg);
    if (!g.closed_form) continue;
    for (const std::size_t k : {0u, 1u, 2u, 4u, 5u}) {
      const int node = leg->joints[k] + 1;
      const Vec3 origin = node_origins(entity)[static_cast<std::size_t>(node)];
      const Vec3 axis = entity.joints[static_cast<std::size_t>(node - 1)].axis;
      shift_frame(entity, node, axis * axis.dot((k < 3 ? g.hip_m : g.ankle_m) - origin));
    }
    // The knee moves into the leg's plane.
    const int knee = leg->joints[3] + 1;
    const Vec3 origin = node_origins(entity)[static_cast<std::size_t>(knee)];
    shift_frame(entity, knee, Vec3(0, g.hip_m.y() - origin.y(), 0));
  }
}

}  // namespace verp::model
