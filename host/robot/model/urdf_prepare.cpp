#include "host/robot/model/urdf_prepare.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "host/robot/model/bounds.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/number.hpp"

namespace verp::model {
namespace {

using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

std::string canonical(const std::string& path) {
  return std::filesystem::weakly_canonical(path).string();
}

std::string name_of(const XMLElement& element) {
  const char* name = element.Attribute("name");
  return name ? name : "";
}

/// Some files write 1e-9 kg; libsdformat reads it as no mass.
bool has_mass(const XMLElement& link) {
  const XMLElement* const inertial = link.FirstChildElement("inertial");
  const XMLElement* const mass = inertial ? inertial->FirstChildElement("mass") : nullptr;
  return mass != nullptr && mass->DoubleAttribute("value") >= kLeastMass_kg;
}

/// Adds a light ball; LinkTree removes it again.
void add_stand_in_mass(XMLElement& link) {
  if (XMLElement* const old = link.FirstChildElement("inertial")) link.DeleteChild(old);
  XMLElement* const inertial = link.InsertNewChildElement("inertial");
  inertial->InsertNewChildElement("mass")->SetAttribute("value", "0.001");
  XMLElement* const inertia = inertial->InsertNewChildElement("inertia");
  for (const char* moment : {"ixx", "iyy", "izz"}) inertia->SetAttribute(moment, "1e-7");
  for (const char* product : {"ixy", "ixz", "iyz"}) inertia->SetAttribute(product, "0");
}

/// XML's white space separates numbers; urdfdom knows blanks only, and three numbers of a scale.
void mend_numbers(XMLElement& element) {
  const char* const scale = element.Attribute("scale");
  if (std::string_view(element.Name()) == "mesh" && scale && parse_number(scale)) {
    const std::string one = scale;
    element.SetAttribute("scale", (one + " " + one + " " + one).c_str());
  }
  for (const auto* each = element.FirstAttribute(); each != nullptr; each = each->Next()) {
    std::string value = each->Value();
    const auto is_space = [](char c) { return c == '\t' || c == '\n' || c == '\r'; };
    if (std::none_of(value.begin(), value.end(), is_space)) continue;
    std::replace_if(value.begin(), value.end(), is_space, ' ');
    element.SetAttribute(each->Name(), value.c_str());
  }
  for (auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    mend_numbers(*child);
  }
}

/// urdfdom wants limits, effort and speed of each joint; here the servo's count.
void complete_limit(XMLElement& joint) {
  XMLElement* const limit = joint.FirstChildElement("limit");
  const char* const type = joint.Attribute("type");
  if (limit == nullptr && type != nullptr && std::string(type) == "revolute")
    joint.SetAttribute("type", "continuous");
  for (const char* const each : {"effort", "velocity"}) {
    if (limit != nullptr && limit->Attribute(each) == nullptr) limit->SetAttribute(each, "0");
  }
}

XMLElement& child_of(XMLElement& parent, const char* name) {
  XMLElement* const found = parent.FirstChildElement(name);
  return found != nullptr ? *found : *parent.InsertNewChildElement(name);
}

/// <verp:inertia ball_m>
void put_balls(XMLElement& robot, const Facts& facts) {
  for (auto* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    for (const InertiaFact& fact : facts.inertias) {
      if (!fact.ball_m || fact.link != name_of(*link)) continue;
      XMLElement& inertial = child_of(*link, "inertial");
      XMLElement& mass = child_of(inertial, "mass");
      if (fact.mass_kg) mass.SetAttribute("value", *fact.mass_kg);
      const double moment = 0.4 * mass.DoubleAttribute("value") * *fact.ball_m * *fact.ball_m;
      XMLElement& inertia = child_of(inertial, "inertia");
      for (const char* each : {"ixx", "iyy", "izz"}) inertia.SetAttribute(each, moment);
      for (const char* each : {"ixy", "ixz", "iyz"}) inertia.SetAttribute(each, "0");
    }
  }
}

/// Exporters repeat a material in each link's file.
void keep_first_materials(XMLElement& robot) {
  std::set<std::string> known;
  for (auto* each = robot.FirstChildElement("material"); each != nullptr;) {
    XMLElement* const next = each->NextSiblingElement("material");
    if (!known.insert(name_of(*each)).second) robot.DeleteChild(each);
    each = next;
  }
}

XMLElement* link_named(XMLElement& robot, const std::string& name) {
  auto* link = robot.FirstChildElement("link");
  while (link != nullptr && name_of(*link) != name) link = link->NextSiblingElement("link");
  return link;
}

std::string end_of(const XMLElement& joint, const char* end) {
  const XMLElement* const element = joint.FirstChildElement(end);
  const char* const link = element ? element->Attribute("link") : nullptr;
  return link ? link : "";
}

void keep_fixed_joint(XMLElement& robot, const std::string& joint) {
  XMLElement* const gazebo = robot.InsertNewChildElement("gazebo");
  gazebo->SetAttribute("reference", joint.c_str());
  gazebo->InsertNewChildElement("preserveFixedJoint")->SetText("true");
}

std::string write_copy(XMLDocument& document, const std::string& original) {
  std::string path = (std::filesystem::temp_directory_path() / "verp_urdf_XXXXXX").string();
  const int file = ::mkstemp(path.data());
  if (file >= 0) ::close(file);
  if (file < 0 || document.SaveFile(path.c_str()) != tinyxml2::XML_SUCCESS) {
    throw LoadError(original, 0, "cannot write a copy of it to " + path,
                    "make room there, or set TMPDIR to a folder that can be written");
  }
  return path;
}

}  // namespace

PreparedUrdfs::PreparedUrdfs(const XmlSource& source, const Facts& facts) {
  for (const XmlElement& robot : source.urdfs()) prepare(robot, facts);
}

PreparedUrdfs::~PreparedUrdfs() {
  std::error_code ignored;
  for (const auto* copies : {&copy_of_, &plain_copy_of_}) {
    for (const auto& [path, copy] : *copies) std::filesystem::remove(copy, ignored);
  }
}

/// A root without mass that carries one joint stands for the world. A robot is on no stand: both
/// go.
void PreparedUrdfs::untie(XMLElement& robot) {
  std::map<std::string, int> joints_at;  // of a link
  for (auto* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    for (const char* const end : {"parent", "child"}) ++joints_at[end_of(*joint, end)];
  }
  for (auto* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    const char* const given = joint->Attribute("type");
    const std::string type = given ? given : "", parent = end_of(*joint, "parent");
    if (type != "floating" && type != "planar" && (type != "fixed" || parent != "world")) continue;
    XMLElement* const link = link_named(robot, parent);
    if (link == nullptr || has_mass(*link) || joints_at[parent] != 1) continue;
    notes_.push_back("joint '" + name_of(*joint) + "' ties the robot to '" + parent +
                     "': left out");
    robot.DeleteChild(link);
    robot.DeleteChild(joint);
    return;
  }
}

void PreparedUrdfs::prepare(const XmlElement& original, const Facts& facts) {
  XMLDocument document;
  original.raw().GetDocument()->DeepCopy(&document);
  XMLElement& robot = *document.RootElement();
  if (robot.Attribute("name") == nullptr) robot.SetAttribute("name", "robot");
  mend_numbers(robot);
  keep_first_materials(robot);
  untie(robot);
  for (auto* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    complete_limit(*joint);
  }
  put_balls(robot, facts);
  const std::string path = canonical(original.file());
  plain_copy_of_[path] = write_copy(document, original.file());
  rename_and_weigh(robot);
  copy_of_[path] = write_copy(document, original.file());
}

void PreparedUrdfs::rename_and_weigh(XMLElement& robot) {
  std::set<std::string> links;
  for (auto* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    links.insert(name_of(*link));
    if (has_mass(*link)) continue;
    add_stand_in_mass(*link);
    names_.massless_links.insert(name_of(*link));
  }
  for (auto* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    std::string name = name_of(*joint);
    if (links.contains(name)) {
      while (links.contains(name)) name += "_joint";
      names_.joint[name] = name_of(*joint);
      joint->SetAttribute("name", name.c_str());
    }
    const char* type = joint->Attribute("type");
    if (type == nullptr || std::string(type) != "fixed") continue;
    keep_fixed_joint(robot, name);
    // Exporters write zeros here, which libsdformat refuses.
    if (XMLElement* const axis = joint->FirstChildElement("axis")) joint->DeleteChild(axis);
  }
}

std::string PreparedUrdfs::plain_copy_of(const std::string& path) const {
  return plain_copy_of_.at(canonical(path));
}

std::string PreparedUrdfs::copy_of(const std::string& path) const {
  const auto found = copy_of_.find(canonical(path));
  return found == copy_of_.end() ? path : found->second;
}

bool PreparedUrdfs::is_copy(const std::string& path) const {
  for (const auto& [original, copy] : copy_of_) {
    if (copy == path) return true;
  }
  return false;
}

}  // namespace verp::model
