#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/author/edit/document.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::edit {

using model::Mat3;
using model::Vec3;

struct Solid {
  enum class Kind { kBox, kSphere, kCapsule, kCylinder } kind = Kind::kBox;
  Vec3 centre_m = Vec3::Zero(), rpy_rad = Vec3::Zero();
  Vec3 size_m = Vec3::Zero();  ///< box: edges; else x radius, z length
};
/// Throws std::invalid_argument with the kinds.
Solid::Kind solid_kind(const std::string& name);
double volume_m3(const Solid& solid);
/// About its own centre and axes, at uniform density.
Mat3 inertia_kg_m2(const Solid& solid, double mass_kg);

struct Mesh {
  std::string uri;  ///< as in the robot's file
  double scale = 1;
};

struct Body {
  double mass_kg = 0;
  Vec3 com_m = Vec3::Zero();
  Mat3 inertia_kg_m2 = Mat3::Zero();  ///< about the centre of mass
  std::optional<Solid> solid;         ///< collision shape; drawn if there is no mesh
  std::optional<Mesh> mesh;           ///< drawn
};
Body body_of(const Solid& solid, double mass_kg);

/// Lines of a <link>; `name` is for the shapes.
std::string link_content(const Document& document, const std::string& name, const Body& body);
/// The link is on a joint or frame (SDF; empty: on the model).
Edit add_link(const Document& document, const std::string& name, const Body& body,
              const std::string& on);

/// Adds "link", "joint", "servo", ... from name=value words. Throws model::LoadError for a missing
/// or unknown word.
using Words = std::map<std::string, std::string>;
Edit add(const Document& document, const std::string& kind, const Words& words);
std::vector<std::string> kinds();
/// For help: "name parent child at axis lower upper".
std::string words_of(const std::string& kind);

}  // namespace verp::edit
