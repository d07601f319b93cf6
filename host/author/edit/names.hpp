#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "host/author/edit/document.hpp"

/// Names of a robot's parts, and the places where one names another.
namespace verp::edit {

/// The name without the prefix "verp:".
std::string short_name(std::string_view element);
/// Distinguishes an element from similar ones: its name, else the joint, link, ... that it refers
/// to.
std::string key_of(const Element& element);

/// Parts that others name. SDF has one set of names for links, joints and frames; URDF has two.
enum class Kind { kNone, kLink, kJoint, kFrame, kSensor };
Kind kind_of(const Document& document, int element);

/// A place that gives or mentions a name.
struct Mention {
  int element;
  Range at;  ///< the name's own bytes
  std::string name;
  bool defines = false;
};
/// All places, in text order, that name or mention a part of that kind.
std::vector<Mention> mentions(const Document& document, Kind kind);

/// True if the name is taken for a part of that kind.
bool is_taken(const Document& document, Kind kind, const std::string& name);

}  // namespace verp::edit
