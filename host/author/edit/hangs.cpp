#include <algorithm>
#include <set>

#include "host/author/edit/change.hpp"
#include "host/author/edit/names.hpp"

namespace verp::edit {
namespace {

std::string end_of(const Document& document, int joint, std::string_view which) {
  const int found = document.child(joint, which);
  if (found < 0) return "";
  return document.is_urdf() ? document.attribute(found, "link") : document.text_of(found);
}

struct Group {
  std::set<std::string> links, joints, frames, sensors;
  std::set<int> elements;
};

bool take(Group& group, std::set<std::string>& names, const std::string& name, int element) {
  names.insert(name);
  return group.elements.insert(element).second;
}

/// One pass; false: nothing was added.
bool grow(const Document& document, Group& group) {
  bool more = false;
  for (const int each : document.markup()[document.model()].children) {
    const std::string name = document.attribute(each, "name");
    const Kind kind = kind_of(document, each);
    if (kind == Kind::kJoint) {
      const std::string child = end_of(document, each, "child");
      if (group.joints.contains(name)) more |= group.links.insert(child).second;
      if (group.links.contains(child) || group.links.contains(end_of(document, each, "parent")))
        more |= take(group, group.joints, name, each);
    } else if (kind == Kind::kLink && group.links.contains(name)) {
      more |= take(group, group.links, name, each);
    } else if (kind == Kind::kFrame) {
      const std::string base = document.attribute(each, "attached_to");
      if (group.links.contains(base) || group.joints.contains(base) || group.frames.contains(base))
        more |= take(group, group.frames, name, each);
    }
  }
  return more;
}

/// The element that depends on the part; -1: it is only placed by the part.
int dependent(const Document& document, int element) {
  const Markup& markup = document.markup();
  if (markup[element].name.starts_with("verp:")) return element;
  if (!document.is_urdf()) return -1;
  if (markup[element].name == "gazebo") return element;
  const int above = markup[element].parent;
  return above >= 0 && markup[above].name == "transmission" ? above : -1;
}

void add_mentions(const Document& document, Kind kind, const std::set<std::string>& names,
                  Group& group) {
  for (const Mention& each : mentions(document, kind)) {
    if (each.defines || !names.contains(each.name)) continue;
    const int found = dependent(document, each.element);
    // A limb depends on its tip; its base may carry other limbs.
    const Element& element = document.markup()[each.element];
    const Attribute* base = element.attribute("base");
    if (base != nullptr && base->value_at.begin == each.at.begin) {
      const Attribute* tip = element.attribute("tip");
      if (tip != nullptr && !names.contains(tip->value)) continue;
    }
    if (found >= 0) group.elements.insert(found);
  }
}

}  // namespace

std::vector<int> what_hangs_on(const Document& document, int element) {
  Group group;
  group.elements.insert(element);
  const std::string name = document.attribute(element, "name");
  switch (kind_of(document, element)) {
    case Kind::kLink:
      group.links.insert(name);
      break;
    case Kind::kJoint:
      group.joints.insert(name);
      break;
    case Kind::kFrame:
      group.frames.insert(name);
      break;
    case Kind::kSensor:
      group.sensors.insert(name);
      break;
    case Kind::kNone:
      return {element};
  }
  while (grow(document, group)) {
  }
  for (const int each : std::set<int>(group.elements)) {
    if (const int sensor = document.child(each, "sensor"); sensor >= 0)
      group.sensors.insert(document.attribute(sensor, "name"));
  }
  add_mentions(document, Kind::kLink, group.links, group);
  add_mentions(document, Kind::kJoint, group.joints, group);
  add_mentions(document, Kind::kFrame, group.frames, group);
  add_mentions(document, Kind::kSensor, group.sensors, group);
  std::vector<int> out;  // in text order
  std::size_t end = 0;
  for (const int each : group.elements) {
    if (document.markup()[each].whole.begin < end) continue;
    out.push_back(each);
    end = document.markup()[each].whole.end;
  }
  return out;
}

}  // namespace verp::edit
