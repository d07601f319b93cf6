#include "host/robot/model/urdf_prepare.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "host/robot/model/bounds.hpp"
#include "host/robot/model/load_error.hpp"

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

PreparedUrdfs::PreparedUrdfs(const XmlSource& source) {
  for (const XmlElement& robot : source.urdfs()) prepare(robot);
}

PreparedUrdfs::~PreparedUrdfs() {
  std::error_code ignored;
  for (const auto& [path, copy] : copy_of_) std::filesystem::remove(copy, ignored);
}

void PreparedUrdfs::prepare(const XmlElement& original) {
  XMLDocument document;
  original.raw().GetDocument()->DeepCopy(&document);
  XMLElement& robot = *document.RootElement();
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
  copy_of_[canonical(original.file())] = write_copy(document, original.file());
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
