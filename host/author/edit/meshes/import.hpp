#pragma once
#include <filesystem>
#include <string>

#include "host/author/edit/parts.hpp"

/// Meshes of other programs as links: STL, OBJ, DAE, glTF through assimp.
namespace verp::edit {

struct ImportOptions {
  double unit_m = 1;   ///< what a length of 1 in the file is; a DAE's own unit comes on top
  double mass_kg = 0;  ///< 0: from the density
  double density_kg_m3 = 1000;
  std::string fit = "box";  ///< box, capsule, cylinder, sphere; or "smallest"
};

struct Imported {
  Body body;
  std::string told;  ///< one line for people: size, volume, what was fitted, what is doubtful
};

/// Throws model::LoadError in the mesh's name for what is none, or is too large.
Imported import_mesh(const std::filesystem::path& mesh, const std::filesystem::path& robot,
                     const ImportOptions& options);

/// The link's inertia, shapes and looks become the mesh's; a link that is not there is made, on
/// that joint (empty: on the model).
Edit put_mesh(const Document& document, const std::string& link, const Body& body,
              const std::string& on);

}  // namespace verp::edit
