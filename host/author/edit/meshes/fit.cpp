#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "host/author/edit/meshes/triangles.hpp"

namespace verp::edit {
namespace {

constexpr double kThin_m = 1e-3;  // a solid needs thickness

/// Candidate rotations: none, and along the points' principal axes.
std::vector<Mat3> turns(const Triangles& mesh) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : mesh.points_m) mean += p / double(mesh.points_m.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : mesh.points_m) spread += (p - mean) * (p - mean).transpose();
  Mat3 axes = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  std::vector<Mat3> all;
  for (const Mat3& base : {Mat3(Mat3::Identity()), axes}) {
    // z is the axis of capsules and cylinders.
    for (int z = 0; z < 3; ++z) {
      Mat3 turn;
      turn << base.col((z + 1) % 3), base.col((z + 2) % 3), base.col(z);
      all.push_back(turn);
    }
  }
  std::rotate(all.begin(), all.begin() + 2, all.begin() + 3);  // unrotated wins ties
  return all;
}

Vec3 angles_of(const Mat3& turn) {
  const double pitch = std::atan2(-turn(2, 0), std::hypot(turn(0, 0), turn(1, 0)));
  return {std::atan2(turn(2, 1), turn(2, 2)), pitch, std::atan2(turn(1, 0), turn(0, 0))};
}

Solid around(const Triangles& mesh, Solid::Kind kind, const Mat3& turn) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.points_m) box.extend(turn.transpose() * p);
  const Vec3 middle = box.center();
  Solid solid{kind, turn * middle, angles_of(turn), box.sizes().cwiseMax(kThin_m)};
  if (kind == Solid::Kind::kBox) return solid;
  double radius = kThin_m / 2, half = 0, far = kThin_m / 2;
  for (const Vec3& point : mesh.points_m) {
    const Vec3 p = turn.transpose() * point - middle;
    radius = std::max(radius, std::hypot(p.x(), p.y()));
    far = std::max(far, p.norm());
  }
  if (kind == Solid::Kind::kSphere) return {kind, solid.centre_m, Vec3::Zero(), Vec3(far, 0, 0)};
  for (const Vec3& point : mesh.points_m) {
    const Vec3 p = turn.transpose() * point - middle;
    const double cap =
        kind == Solid::Kind::kCapsule
            ? std::sqrt(std::max(0.0, radius * radius - p.x() * p.x() - p.y() * p.y()))
            : 0;
    half = std::max(half, std::abs(p.z()) - cap);
  }
  solid.size_m = Vec3(radius, 0, std::max(2 * half, kThin_m));
  return solid;
}

}  // namespace

Solid fitted(const Triangles& mesh, Solid::Kind kind) {
  Solid best;
  double least = -1;
  for (const Mat3& turn : turns(mesh)) {
    const Solid solid = around(mesh, kind, turn);
    const double volume = volume_m3(solid);
    if (least >= 0 && volume > 0.98 * least) continue;  // a rotation must save 2 %
    best = solid;
    least = volume;
  }
  return best;
}

}  // namespace verp::edit
