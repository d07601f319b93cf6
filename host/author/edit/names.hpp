#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "host/author/edit/document.hpp"

namespace verp::edit {

/// The name without "verp:".
std::string short_name(std::string_view element);
/// Its name, else that of the part it refers to.
std::string key_of(const Element& element);

/// SDF has one set of names for links, joints and frames; URDF has two.
enum class Kind { kNone, kLink, kJoint, kFrame, kSensor };
Kind kind_of(const Document& document, int element);

struct Mention {
  int element;
  Range at;  ///< the name's own bytes
  std::string name;
  bool defines = false;
};
/// All places, in text order, that name or mention a part of that kind.
std::vector<Mention> mentions(const Document& document, Kind kind);

bool is_taken(const Document& document, Kind kind, const std::string& name);

}  // namespace verp::edit
