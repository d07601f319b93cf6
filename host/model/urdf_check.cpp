#include "host/model/urdf_check.hpp"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <set>
#include <string>

#include "host/model/load_error.hpp"

namespace verp::model {
namespace {

/// The line of <kind name="...">, or that of the root.
XmlElement element_of(const XmlElement& robot, const char* kind, const std::string& name) {
  for (const XmlElement& child : robot.children(kind)) {
    if (child.text("name", "") == name) return child;
  }
  return robot;
}

void check_links(const XmlElement& robot, const urdf::ModelInterface& urdf, const Facts& facts) {
  for (const auto& [name, link] : urdf.links_) {
    if (link->inertial || facts.is_dropped("massless_link", name)) continue;
    element_of(robot, "link", name)
        .fail(
            "link '" + name + "' has no mass: the import would drop it and all that hangs on it",
            "declare it: <verp:drop what=\"massless_link\" name=\"" + name + "\" reason=\"...\"/>");
  }
  for (const auto& [name, link] : urdf.links_) {
    if (link->inertial || link->child_joints.empty()) continue;
    if (link->parent_joint == nullptr) continue;  // a massless root is lumped, not lost
    element_of(robot, "link", name)
        .fail(
            "link '" + name + "' has no mass but carries other links, which would be lost with it",
            "use a file that gives it a mass");
  }
}

}  // namespace

UrdfTotals check_urdf(const XmlElement& robot, const Facts& facts) {
  console_bridge::noOutputHandler();
  const auto urdf = urdf::parseURDFFile(robot.file());
  if (!urdf) {
    robot.fail("urdfdom cannot read this URDF", "run check_urdf on it (package liburdfdom-tools)");
  }
  std::set<std::string> names;
  for (const auto& [name, link] : urdf->links_) names.insert(name);
  check_links(robot, *urdf, facts);
  UrdfTotals totals;
  for (const auto& [name, joint] : urdf->joints_) {
    const XmlElement at = element_of(robot, "joint", name);
    if (names.contains(name)) {
      at.fail("a link and a joint are both called '" + name + "'", "rename one of them");
    }
    if (joint->mimic && !facts.is_dropped("mimic", name)) {
      at.fail("joint '" + name + "' mimics another: the import would make it free",
              "declare it: <verp:drop what=\"mimic\" name=\"" + name + "\" reason=\"...\"/>");
    }
    if (joint->type != urdf::Joint::FIXED) ++totals.moving_joints;
  }
  for (const auto& [name, link] : urdf->links_) {
    if (link->inertial) totals.mass_kg += link->inertial->mass;
  }
  return totals;
}

}  // namespace verp::model
