#include "host/robot/model/urdf_check.hpp"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "host/robot/model/load_error.hpp"
#include "host/robot/model/number.hpp"

namespace verp::model {
namespace {

/// The element <kind name="...">, or the root.
XmlElement element_of(const XmlElement& robot, const char* kind, const std::string& name) {
  for (const XmlElement& child : robot.children(kind)) {
    if (child.text("name", "") == name) return child;
  }
  return robot;
}

/// Collects urdfdom's errors: first the cause, then what could not be read.
class UrdfErrors : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/,
           int /*line*/) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    if (cause_.empty()) cause_ = text.substr(0, text.find(".  "));  // multi-line advice follows
    all_ += text + '\n';
  }
  const std::string& cause() const { return cause_; }
  const std::string& all() const { return all_; }

 private:
  std::string cause_, all_;
};

void refuse_duplicates(const XmlElement& robot, const char* kind) {
  std::set<std::string> names;
  for (const XmlElement& child : robot.children(kind)) {
    if (names.insert(child.text("name")).second) continue;
    child.fail(std::string(kind) + " '" + child.text("name") + "' is given twice",
               "rename one of them");
  }
}

/// urdfdom names no link of a loop.
void refuse_loops(const XmlElement& robot) {
  std::map<std::string, std::string> parent;
  for (const XmlElement& joint : robot.children("joint")) {
    std::string link, carrier;
    for (const XmlElement& each : joint.children("child")) link = each.text("link", "");
    for (const XmlElement& each : joint.children("parent")) carrier = each.text("link", "");
    parent[link] = carrier;
    std::string above = carrier;
    for (std::size_t i = 0; i < parent.size() && above != link && parent.contains(above); ++i)
      above = parent[above];
    if (above != link || link.empty()) continue;
    joint.fail("joint '" + joint.text("name", "") + "' hangs link '" + link + "' on itself" +
                   (carrier == link ? "" : ", by way of '" + carrier + "'"),
               "correct its <parent> or <child>");
  }
}

/// urdfdom does not name the joint of a bad number either.
void refuse_no_ratio(const XmlElement& robot) {
  for (const XmlElement& joint : robot.children("joint")) {
    for (const XmlElement& mimic : joint.children("mimic")) {
      mimic.number("multiplier", 1);
      mimic.number("offset", 0);
    }
  }
}

/// Only the root of the trunk has no parent joint.
void refuse_second_root(const XmlElement& robot, const Facts& facts) {
  std::map<std::string, std::string> parent;
  for (const XmlElement& joint : robot.children("joint")) {
    for (const XmlElement& child : joint.children("child")) {
      for (const XmlElement& carrier : joint.children("parent")) {
        parent[child.text("link", "")] = carrier.text("link", "");
      }
    }
  }
  std::string trunk = facts.body->link;
  for (std::size_t i = 0; i < parent.size() && parent.contains(trunk); ++i) trunk = parent[trunk];
  std::vector<XmlElement> roots = robot.children("link");
  std::erase_if(roots, [&](const XmlElement& link) { return parent.contains(link.text("name")); });
  if (roots.size() < 2) return;
  roots[roots[0].text("name") == trunk ? 1 : 0].fail(
      "two root links: '" + roots[0].text("name") + "' and '" + roots[1].text("name") + "'",
      "add the joint that carries one of them");
}

/// libsdformat rejects such a joint without name or line.
void refuse_no_direction(const XmlElement& robot) {
  for (const XmlElement& joint : robot.children("joint")) {
    if (joint.text("type", "") == "fixed") continue;
    for (const XmlElement& axis : joint.children("axis")) {
      const auto xyz = parse_numbers(axis.text("xyz", "1 0 0"));
      const bool none =
          xyz && std::all_of(xyz->begin(), xyz->end(), [](double x) { return x == 0; });
      if (!none) continue;
      axis.fail("joint '" + joint.text("name") + "' turns about no axis",
                "write the axis in <axis> xyz");
    }
  }
}

/// A servo's row may have them instead.
void refuse_no_limit(const XmlElement& robot, const Facts& facts) {
  for (const ServoFact& servo : facts.bus().servos) {
    if (servo.lower_rad && servo.upper_rad) continue;
    const XmlElement joint = element_of(robot, "joint", servo.joint);
    if (joint.name() != "joint" || joint.text("type", "") != "revolute") continue;
    if (joint.children("limit").empty()) {
      joint.fail("joint '" + servo.joint + "' has no limits",
                 "add <limit> with lower and upper, in radians");
    }
  }
}

std::shared_ptr<urdf::ModelInterface> read_urdf(const XmlSource& source, const XmlElement& robot,
                                                const Facts& facts, const std::string& copy) {
  for (const char* kind : {"link", "joint"}) refuse_duplicates(robot, kind);
  refuse_loops(robot);
  refuse_no_ratio(robot);
  refuse_second_root(robot, facts);
  refuse_no_direction(robot);
  refuse_no_limit(robot, facts);
  UrdfErrors errors;
  console_bridge::useOutputHandler(&errors);
  auto urdf = urdf::parseURDFFile(copy);
  console_bridge::noOutputHandler();
  if (urdf) return urdf;
  for (const XmlElement& joint : robot.children("joint")) {  // a link may have the same name
    const std::string own = "oint [" + joint.text("name", "") + "]";
    if (errors.all().find(own) == std::string::npos) continue;
    joint.fail("this is no URDF of a robot: " + errors.cause(),
               "correct it; wiki.ros.org/urdf/XML says what is needed");
  }
  const auto place = source.blame(errors.all());
  const bool named = place.file == robot.file();
  throw LoadError(robot.file(), named ? place.line : robot.line(),
                  "this is no URDF of a robot: " + errors.cause(),
                  "correct it; wiki.ros.org/urdf/XML says what is needed");
}

/// A frame needs no mass; a link with a shape does.
void check_links(const XmlElement& robot, const urdf::ModelInterface& urdf, const Facts& facts) {
  for (const auto& [name, link] : urdf.links_) {
    const bool is_frame = link->visual_array.empty() && link->collision_array.empty();
    if (link->inertial || is_frame || facts.is_dropped("massless_link", name)) continue;
    element_of(robot, "link", name)
        .fail("link '" + name + "' has a shape and no mass",
              "give it an <inertial>, or declare: <verp:drop what=\"massless_link\" name=\"" +
                  name + "\" reason=\"...\"/>");
  }
}

}  // namespace

UrdfTotals check_urdf(const XmlSource& source, const XmlElement& robot, const Facts& facts,
                      const std::string& copy) {
  const auto urdf = read_urdf(source, robot, facts, copy);
  check_links(robot, *urdf, facts);
  UrdfTotals totals;
  for (const auto& [name, joint] : urdf->joints_) {
    if (joint->type != urdf::Joint::FIXED) ++totals.moving_joints;
  }
  for (const auto& [name, link] : urdf->links_) {
    if (link->inertial) totals.mass_kg += link->inertial->mass;
  }
  return totals;
}

}  // namespace verp::model
