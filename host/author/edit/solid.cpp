#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "host/author/edit/parts.hpp"

namespace verp::edit {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array kSolids = {"box", "sphere", "capsule", "cylinder"};

std::string row(const Vec3& v) {
  return fmt::format("{:.6g} {:.6g} {:.6g}", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

Vec3 moments(const Solid& solid, double mass_kg) {
  const Vec3& s = solid.size_m;
  const double r = s.x(), l = s.z();
  switch (solid.kind) {
    case Solid::Kind::kBox: {
      const Vec3 q = s.cwiseProduct(s);
      return mass_kg / 12 * Vec3(q.y() + q.z(), q.x() + q.z(), q.x() + q.y());
    }
    case Solid::Kind::kSphere:
      return Vec3::Constant(0.4 * mass_kg * r * r);
    case Solid::Kind::kCylinder: {
      const double across = mass_kg * (3 * r * r + l * l) / 12;
      return {across, across, mass_kg * r * r / 2};
    }
    case Solid::Kind::kCapsule: {
      const double tube = kPi * r * r * l, balls = 4 * kPi * r * r * r / 3;
      const double m = mass_kg * tube / (tube + balls), b = mass_kg - m;
      const double across =
          m * (3 * r * r + l * l) / 12 + b * (0.4 * r * r + l * l / 4 + 3 * r * l / 8);
      return {across, across, m * r * r / 2 + 0.4 * b * r * r};
    }
  }
  return Vec3::Zero();
}

std::string geometry(const Document& document, const Solid& solid) {
  const Vec3& s = solid.size_m;
  const char* kind = kSolids[std::size_t(solid.kind)];
  if (document.is_urdf()) {
    if (solid.kind == Solid::Kind::kCapsule) {
      throw model::LoadError(document.file().string(), 0, "URDF has no capsules",
                             "choose box, sphere or cylinder");
    }
    if (solid.kind == Solid::Kind::kBox)
      return fmt::format("<geometry><box size=\"{}\"/></geometry>", row(s));
    if (solid.kind == Solid::Kind::kSphere)
      return fmt::format("<geometry><sphere radius=\"{:.6g}\"/></geometry>", s.x());
    return fmt::format("<geometry><cylinder radius=\"{:.6g}\" length=\"{:.6g}\"/></geometry>",
                       s.x(), s.z());
  }
  if (solid.kind == Solid::Kind::kBox)
    return fmt::format("<geometry><box><size>{}</size></box></geometry>", row(s));
  const std::string length =
      solid.kind == Solid::Kind::kSphere ? "" : fmt::format("<length>{:.6g}</length>", s.z());
  return fmt::format("<geometry><{0}><radius>{1:.6g}</radius>{2}</{0}></geometry>", kind, s.x(),
                     length);
}

std::string pose(const Document& document, const Vec3& at, const Vec3& rpy) {
  return document.is_urdf() ? fmt::format("<origin xyz=\"{}\" rpy=\"{}\"/>", row(at), row(rpy))
                            : fmt::format("<pose>{} {}</pose>", row(at), row(rpy));
}

std::string mesh_geometry(const Document& document, const Mesh& mesh) {
  const std::string uri = escaped(mesh.uri),
                    scale = fmt::format("{0:.6g} {0:.6g} {0:.6g}", mesh.scale);
  if (document.is_urdf())
    return fmt::format("<geometry><mesh filename=\"{}\" scale=\"{}\"/></geometry>", uri, scale);
  return fmt::format("<geometry><mesh><uri>{}</uri><scale>{}</scale></mesh></geometry>", uri,
                     scale);
}

std::string inertial(const Document& document, const Body& body) {
  const Mat3& i = body.inertia_kg_m2;
  const std::string where = pose(document, body.com_m, Vec3::Zero());
  const char* format =
      document.is_urdf()
          ? "<inertial>\n  {}\n  <mass value=\"{:.6g}\"/>\n  <inertia ixx=\"{:.6g}\" "
            "iyy=\"{:.6g}\" "
            "izz=\"{:.6g}\" ixy=\"{:.6g}\" ixz=\"{:.6g}\" iyz=\"{:.6g}\"/>\n</inertial>"
          : "<inertial>\n  {}\n  <mass>{:.6g}</mass>\n  <inertia><ixx>{:.6g}</ixx><iyy>{:.6g}</iyy>"
            "<izz>{:.6g}</izz><ixy>{:.6g}</ixy><ixz>{:.6g}</ixz><iyz>{:.6g}</iyz></inertia>\n</"
            "inertial>";
  return fmt::format(fmt::runtime(format), where, body.mass_kg, i(0, 0), i(1, 1), i(2, 2),
                     i(0, 1) + 0.0, i(0, 2) + 0.0, i(1, 2) + 0.0);
}

}  // namespace

Solid::Kind solid_kind(const std::string& name) {
  for (std::size_t i = 0; i < kSolids.size(); ++i) {
    if (name == kSolids[i]) return Solid::Kind(i);
  }
  throw std::invalid_argument("'" + name + "' is none of box, sphere, capsule, cylinder");
}

double volume_m3(const Solid& solid) {
  const double r = solid.size_m.x(), l = solid.size_m.z();
  switch (solid.kind) {
    case Solid::Kind::kBox:
      return solid.size_m.prod();
    case Solid::Kind::kSphere:
      return 4 * kPi * r * r * r / 3;
    case Solid::Kind::kCapsule:
      return kPi * r * r * l + 4 * kPi * r * r * r / 3;
    case Solid::Kind::kCylinder:
      return kPi * r * r * l;
  }
  return 0;
}

Mat3 inertia_kg_m2(const Solid& solid, double mass_kg) {
  return moments(solid, mass_kg).asDiagonal();
}

Body body_of(const Solid& solid, double mass_kg) {
  return {mass_kg, solid.centre_m, inertia_kg_m2(solid, mass_kg), solid, {}};
}

std::string link_content(const Document& document, const std::string& name, const Body& body) {
  std::string out = inertial(document, body);
  const std::string own = escaped(name);
  if (body.solid) {
    const std::string inner = pose(document, body.solid->centre_m, body.solid->rpy_rad) + "\n  " +
                              geometry(document, *body.solid);
    out += fmt::format("\n<collision name=\"{}_collision\">\n  {}\n</collision>", own, inner);
    if (!body.mesh)
      out += fmt::format("\n<visual name=\"{}_visual\">\n  {}\n</visual>", own, inner);
  }
  if (body.mesh) {
    out += fmt::format("\n<visual name=\"{}_visual\">\n  {}\n</visual>", own,
                       mesh_geometry(document, *body.mesh));
  }
  return out;
}

}  // namespace verp::edit
