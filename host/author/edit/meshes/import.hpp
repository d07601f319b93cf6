#pragma once
#include <filesystem>
#include <string>

#include "host/author/edit/parts.hpp"

/// Imports meshes as links: STL, OBJ, DAE, glTF by assimp.
namespace verp::edit {

struct ImportOptions {
  double unit_m = 1;   ///< metres per unit; a DAE's own unit is on top
  double mass_kg = 0;  ///< 0: from the density
  double density_kg_m3 = 1000;
  std::string fit = "box";  ///< or capsule, cylinder, sphere, "smallest"
};

struct Imported {
  Body body;
  std::string told;  ///< size, volume, fit, doubts
};

/// Throws model::LoadError for a file that is no mesh or too large.
Imported import_mesh(const std::filesystem::path& mesh, const std::filesystem::path& robot,
                     const ImportOptions& options);

/// Replaces inertia, shapes and visuals; creates a missing link on joint `on` (empty: on the
/// model).
Edit put_mesh(const Document& document, const std::string& link, const Body& body,
              const std::string& on);

}  // namespace verp::edit
