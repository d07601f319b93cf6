#include "host/author/edit/meshes/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "host/author/edit/change.hpp"
#include "host/author/edit/meshes/triangles.hpp"
#include "host/robot/model/principal.hpp"

namespace verp::edit {
namespace {

namespace fs = std::filesystem;

Solid solid_for(const Triangles& mesh, const std::string& fit, const fs::path& file) {
  if (fit != "smallest") {
    try {
      return fitted(mesh, solid_kind(fit));
    } catch (const std::invalid_argument& error) {
      throw model::LoadError(file.string(), 0, error.what(), "or let --fit be smallest");
    }
  }
  Solid best = fitted(mesh, Solid::Kind::kBox);
  for (const auto kind : {Solid::Kind::kCapsule, Solid::Kind::kCylinder, Solid::Kind::kSphere}) {
    const Solid other = fitted(mesh, kind);
    if (volume_m3(other) < volume_m3(best)) best = other;
  }
  return best;
}

std::string in_words(const Solid& solid) {
  const Vec3 mm = 1000 * solid.size_m;
  switch (solid.kind) {
    case Solid::Kind::kBox:
      return fmt::format("a box of {:.4g} x {:.4g} x {:.4g} mm", mm.x(), mm.y(), mm.z());
    case Solid::Kind::kSphere:
      return fmt::format("a sphere of radius {:.4g} mm", mm.x());
    default:
      return fmt::format("a {} of radius {:.4g} mm, {:.4g} mm long",
                         solid.kind == Solid::Kind::kCapsule ? "capsule" : "cylinder", mm.x(),
                         mm.z());
  }
}

/// In the link's axes.
Mat3 turned_inertia(const Solid& solid, double mass_kg) {
  const Mat3 turn = model::rotation_rpy(solid.rpy_rad);
  return turn * inertia_kg_m2(solid, mass_kg) * turn.transpose();
}

}  // namespace

Imported import_mesh(const fs::path& file, const fs::path& robot, const ImportOptions& options) {
  const Triangles mesh = read_triangles(file, options.unit_m);
  const Filling inside = filling(mesh);
  const Solid solid = solid_for(mesh, options.fit, file);
  const double volume = inside.closed ? inside.volume_m3 : volume_m3(solid);
  Body body;
  body.mass_kg = options.mass_kg > 0 ? options.mass_kg : options.density_kg_m3 * volume;
  body.com_m = inside.closed ? inside.centre_m : solid.centre_m;
  body.inertia_kg_m2 = inside.closed ? Mat3(body.mass_kg * inside.inertia_per_kg)
                                     : turned_inertia(solid, body.mass_kg);
  body.solid = solid;
  const fs::path folder = fs::absolute(robot).parent_path();
  body.mesh = Mesh{
      fs::absolute(file).lexically_normal().lexically_relative(folder.lexically_normal()).string(),
      options.unit_m};
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.points_m) box.extend(p);
  const Vec3 mm = 1000 * box.sizes();
  const std::string told = fmt::format(
      "{:.4g} x {:.4g} x {:.4g} mm, {:.4g} cm3{}; {:.4g} kg; collides as {}", mm.x(), mm.y(),
      mm.z(), 1e6 * volume,
      inside.closed ? "" : " (it is not closed: volume and inertia of the shape around it)",
      body.mass_kg, in_words(solid));
  return {body, told};
}

Edit put_mesh(const Document& document, const std::string& link, const Body& body,
              const std::string& on) {
  const auto found = document.look_for("link:" + link);
  if (!found) return add_link(document, link, body, on);
  return together(document, "import into " + link, [&](Document& copy) {
    const auto is_old = [&](int each) {
      const std::string& name = copy.markup()[each].name;
      return name == "inertial" || name == "collision" || name == "visual";
    };
    while (true) {
      const auto& children = copy.markup()[*found].children;
      const auto old = std::find_if(children.begin(), children.end(), is_old);
      if (old == children.end()) break;
      copy.apply(remove(copy, *old));
    }
    copy.apply(insert(copy, *found, link_content(copy, link, body)));
  });
}

}  // namespace verp::edit
