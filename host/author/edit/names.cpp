#include "host/author/edit/names.hpp"

#include <algorithm>
#include <array>

namespace verp::edit {
namespace {

constexpr unsigned kLinks = 1, kJoints = 2, kFrames = 4, kSensors = 8, kPlaces = 7;

unsigned bit(Kind kind) {
  return kind == Kind::kNone ? 0 : 1u << (int(kind) - 1);
}

struct Rule {
  std::string_view element, attribute;  ///< empty element: any; empty attribute: the element's text
  unsigned kinds;
};

// SDF's and ours (host/guide/robot-file.md), then URDF's.
constexpr std::array kSdf = {
    Rule{"parent", "", kPlaces},
    Rule{"child", "", kPlaces},
    Rule{"", "relative_to", kPlaces},
    Rule{"", "attached_to", kPlaces},
    Rule{"", "expressed_in", kPlaces},
    Rule{"", "link", kLinks | kFrames},
    Rule{"verp:no_collide", "other", kLinks},
    Rule{"", "frame", kLinks | kFrames},
    Rule{"", "base", kLinks | kFrames},
    Rule{"", "tip", kLinks | kFrames},
    Rule{"", "joint", kJoints},
    Rule{"verp:mimic", "follows", kJoints},
    Rule{"verp:joint", "name", kJoints},
    Rule{"", "sensor", kSensors},
};
constexpr std::array kUrdf = {
    Rule{"parent", "link", kLinks},
    Rule{"child", "link", kLinks},
    Rule{"gazebo", "reference", kLinks | kJoints},
    Rule{"mimic", "joint", kJoints},
};

template <class Rules>
const Rule* rule_for(const Rules& rules, std::string_view element, std::string_view attribute) {
  const auto found = std::find_if(rules.begin(), rules.end(), [&](const Rule& rule) {
    return (rule.element.empty() || rule.element == element) && rule.attribute == attribute;
  });
  return found == rules.end() ? nullptr : &*found;
}

const Rule* rule_for(const Document& document, const Element& element, std::string_view attribute) {
  return document.is_urdf() ? rule_for(kUrdf, element.name, attribute)
                            : rule_for(kSdf, element.name, attribute);
}

}  // namespace

std::string short_name(std::string_view element) {
  return std::string(element.substr(element.starts_with("verp:") ? 5 : 0));
}

std::string key_of(const Element& element) {
  for (const char* name : {"name", "joint", "link", "frame", "sensor"}) {
    if (const Attribute* found = element.attribute(name)) return found->value;
  }
  return "";
}

Kind kind_of(const Document& document, int index) {
  const Element& element = document.markup()[index];
  if (element.name == "sensor") return Kind::kSensor;
  if (element.parent != document.model()) {
    return Kind::kNone;  // a transmission's joints are only mentions
  }
  if (element.name == "link") return Kind::kLink;
  if (element.name == "joint") return Kind::kJoint;
  return element.name == "frame" ? Kind::kFrame : Kind::kNone;
}

std::vector<Mention> mentions(const Document& document, Kind kind) {
  std::vector<Mention> found;
  const auto& all = document.markup().elements();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int index = int(i);
    const Element& element = all[i];
    for (const Attribute& attribute : element.attributes) {
      const bool defines = attribute.name == "name" && kind_of(document, index) == kind;
      const Rule* rule = rule_for(document, element, attribute.name);
      const bool transmission = document.is_urdf() && element.name == "joint" &&
                                element.parent != document.model() && kind == Kind::kJoint &&
                                attribute.name == "name";
      if (!defines && !transmission && (rule == nullptr || (rule->kinds & bit(kind)) == 0))
        continue;
      found.push_back({index, attribute.value_at, attribute.value, defines});
    }
    const Rule* rule = element.children.empty() ? rule_for(document, element, "") : nullptr;
    if (rule == nullptr || (rule->kinds & bit(kind)) == 0) continue;
    found.push_back(
        {index, document.markup().text_at(index, document.text()), document.text_of(index), false});
  }
  return found;
}

bool is_taken(const Document& document, Kind kind, const std::string& name) {
  const auto taken_by = [&](Kind other) {
    const auto all = mentions(document, other);
    return std::any_of(all.begin(), all.end(),
                       [&](const Mention& each) { return each.defines && each.name == name; });
  };
  if (kind == Kind::kSensor || document.is_urdf()) return taken_by(kind);
  return taken_by(Kind::kLink) || taken_by(Kind::kJoint) || taken_by(Kind::kFrame);
}

}  // namespace verp::edit
