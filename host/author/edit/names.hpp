#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "host/author/edit/document.hpp"

/// What parts of a robot are called, and where one names another.
namespace verp::edit {

/// Without "verp:", which nobody needs to type.
std::string short_name(std::string_view element);
/// What tells an element from others alike: its name, else the joint, link, ... that it is about.
std::string key_of(const Element& element);

/// Parts that others name. SDF has one set of names for links, joints and frames; URDF two.
enum class Kind { kNone, kLink, kJoint, kFrame, kSensor };
Kind kind_of(const Document& document, int element);

/// A place where a name stands: `is` what of.
struct Mention {
  int element;
  Range at;  ///< the name's own bytes
  std::string name;
  bool defines = false;
};
/// Each place, in the order of the text, that gives a name to a part of that kind or mentions one.
std::vector<Mention> mentions(const Document& document, Kind kind);

/// Whether something of that name is there that a part of that kind may not be named too.
bool is_taken(const Document& document, Kind kind, const std::string& name);

}  // namespace verp::edit
