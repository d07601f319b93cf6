#include "host/author/mjcf/solids.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "host/robot/model/mesh_file.hpp"

namespace verp::mjcf {
namespace {

/// Of 1 kg/m3.
struct Solid {
  double volume_m3 = 0;
  Vec3 centre_m = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();  ///< about the centre, kg m2
};

Mat3 point_inertia(double mass_kg, const Vec3& at) {
  return mass_kg * (at.squaredNorm() * Mat3::Identity() - at * at.transpose());
}

/// From the moments of second order about the centre.
Mat3 from_second(const Mat3& second) {
  return second.trace() * Mat3::Identity() - second;
}

Solid capsule(double radius_m, double half_m) {
  const double pi = std::numbers::pi, r2 = radius_m * radius_m;
  const double barrel = 2 * pi * r2 * half_m, balls = 4.0 / 3 * pi * r2 * radius_m;
  const double out_m = half_m + 3.0 / 8 * radius_m;  // centre of a half ball
  const double across = barrel * r2 / 4 + balls * r2 / 5;
  const double along = barrel * half_m * half_m / 3 +
                       balls * (r2 / 5 - std::pow(3.0 / 8 * radius_m, 2) + out_m * out_m);
  return {barrel + balls, Vec3::Zero(),
          from_second(Vec3(across, across, along).asDiagonal().toDenseMatrix())};
}

/// Signed volumes of the tetrahedra from the origin; an open surface gives what they sum to.
Solid mesh(const model::Mesh& mesh) {
  Solid out;
  Mat3 second = Mat3::Zero();
  for (const auto& corner : mesh.triangle) {
    const Vec3 &a = mesh.vertex_m[corner[0]], &b = mesh.vertex_m[corner[1]],
               &c = mesh.vertex_m[corner[2]];
    const double volume = a.dot(b.cross(c)) / 6;
    const Vec3 sum = a + b + c;
    out.volume_m3 += volume;
    out.centre_m += volume / 4 * sum;
    second += volume / 20 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (std::abs(out.volume_m3) < 1e-12) return {};
  out.centre_m /= out.volume_m3;
  second -= out.volume_m3 * out.centre_m * out.centre_m.transpose();
  out.inertia = from_second(second);
  if (out.volume_m3 < 0) out.volume_m3 = -out.volume_m3, out.inertia = -out.inertia;
  return out;
}

Solid solid_of(const Geom& geom, const Robot& robot) {
  const Vec3 s = geom.size, square = s.cwiseProduct(s);
  const double pi = std::numbers::pi;
  const auto whole = [&](double volume, const Vec3& second_per_m3) {
    return Solid{volume, Vec3::Zero(),
                 from_second(Mat3((volume * second_per_m3).asDiagonal().toDenseMatrix()))};
  };
  switch (geom.kind) {
    case Geom::Kind::kBox:
      return whole(8 * s.prod(), square / 3);
    case Geom::Kind::kSphere:
      return whole(4.0 / 3 * pi * s.x() * square.x(), Vec3::Constant(square.x() / 5));
    case Geom::Kind::kEllipsoid:
      return whole(4.0 / 3 * pi * s.prod(), square / 5);
    case Geom::Kind::kCylinder:
      return whole(2 * pi * square.x() * s.y(), {square.x() / 4, square.x() / 4, square.y() / 3});
    case Geom::Kind::kCapsule:
      return capsule(s.x(), s.y());
    case Geom::Kind::kMesh:
      break;
  }
  const Mesh& file = robot.meshes.at(geom.mesh);
  try {
    return mesh(*model::read_mesh_to_touch(file.file, file.scale));
  } catch (const std::runtime_error&) {
    return {};  // the loader names missing meshes
  }
}

}  // namespace

std::optional<Inertial> inertial_of_geoms(const Body& body, const Robot& robot) {
  double mass_kg = 0;
  Vec3 first = Vec3::Zero();
  Mat3 about_origin = Mat3::Zero();
  for (const Geom& geom : body.geoms) {
    if (geom.mass_kg == 0 || (geom.mass_kg < 0 && geom.density_kg_m3 == 0)) continue;
    const Solid solid = solid_of(geom, robot);
    if (!(solid.volume_m3 > 0)) continue;
    const double own_kg = geom.mass_kg > 0 ? geom.mass_kg : geom.density_kg_m3 * solid.volume_m3;
    const Vec3 centre = geom.pose * solid.centre_m;
    const Mat3 turn = geom.pose.linear();
    mass_kg += own_kg;
    first += own_kg * centre;
    about_origin += own_kg / solid.volume_m3 * turn * solid.inertia * turn.transpose() +
                    point_inertia(own_kg, centre);
  }
  if (!(mass_kg > 0)) return std::nullopt;
  Inertial out;
  out.mass_kg = mass_kg;
  out.pose.translation() = first / mass_kg;
  out.inertia_kg_m2 = about_origin - point_inertia(mass_kg, out.pose.translation());
  return out;
}

}  // namespace verp::mjcf
