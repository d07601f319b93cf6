#include "host/author/mjcf/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "host/robot/model/load_error.hpp"
#include "host/robot/model/malformed_xml.hpp"
#include "host/robot/model/number.hpp"

namespace verp::mjcf {
namespace {

namespace fs = std::filesystem;
constexpr int kMostDepth = 64;  // of includes in includes: more is a loop
constexpr std::size_t kMostFiles = 256;
// They set one record in MuJoCo: a default of <general> is one of <position>, too.
constexpr std::array kActuators = {"general",     "motor",    "position", "velocity", "damper",
                                   "intvelocity", "cylinder", "muscle",   "adhesion"};

bool is_actuator(const std::string& element) {
  return std::find(kActuators.begin(), kActuators.end(), element) != kActuators.end();
}

std::string key_of(const std::string& element) {
  return is_actuator(element) ? "actuator" : element;
}

Mat3 turned(double angle_rad, const Vec3& axis) {
  return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
}

}  // namespace

std::optional<std::string> Item::find(const char* attribute) const {
  if (element_.has(attribute)) return element_.text(attribute);
  return document_->preset(element_, element_.text("class", class_), attribute);
}

std::string Item::text(const char* attribute, const std::string& fallback) const {
  return find(attribute).value_or(fallback);
}

std::vector<double> Item::numbers(const char* attribute, std::size_t least,
                                  std::size_t most) const {
  const auto text = find(attribute);
  if (!text) return {};
  const auto found = model::parse_numbers(*text);
  if (found && found->size() >= least && found->size() <= most) return *found;
  const std::string count =
      least == most ? std::to_string(least) : fmt::format("{} to {}", least, most);
  element_.fail(fmt::format("<{}> {}=\"{}\" is not {} number{}", element_.name(), attribute, *text,
                            count, most == 1 ? "" : "s"),
                "correct it");
}

double Item::number(const char* attribute, double fallback) const {
  const auto found = numbers(attribute, 1, 1);
  return found.empty() ? fallback : found[0];
}

Vec3 Item::vector(const char* attribute, const Vec3& fallback) const {
  const auto found = numbers(attribute, 3, 3);
  return found.empty() ? fallback : Vec3(found[0], found[1], found[2]);
}

std::optional<bool> Item::flag(const char* attribute) const {
  const auto text = find(attribute);
  if (!text || *text == "auto") return std::nullopt;
  if (*text == "true" || *text == "1") return true;
  if (*text == "false" || *text == "0") return false;
  element_.fail(
      fmt::format("<{}> {}=\"{}\" is neither true nor false", element_.name(), attribute, *text),
      "write true, false or auto");
}

Mat3 Item::turned_by_euler(const std::vector<double>& angles) const {
  const double unit = document_->compiler().degrees ? std::numbers::pi / 180 : 1;
  Mat3 out = Mat3::Identity();
  for (std::size_t i = 0; i < 3; ++i) {
    const char letter = document_->compiler().euler[i];
    const int axis = std::tolower(static_cast<unsigned char>(letter)) - 'x';
    const Mat3 turn = turned(angles[i] * unit, Vec3::Unit(axis));
    out =
        std::islower(static_cast<unsigned char>(letter)) != 0 ? Mat3(out * turn) : Mat3(turn * out);
  }
  return out;
}

Mat3 Item::rotation() const {
  const double unit = document_->compiler().degrees ? std::numbers::pi / 180 : 1;
  if (const auto q = numbers("quat", 4, 4); !q.empty()) {
    const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
    if (turn.norm() < 1e-9) element_.fail("quat is zero", "write w x y z, like 1 0 0 0");
    return turn.normalized().toRotationMatrix();
  }
  if (const auto a = numbers("axisangle", 4, 4); !a.empty()) {
    const Vec3 axis(a[0], a[1], a[2]);
    if (axis.norm() < 1e-9) element_.fail("the axis of axisangle is zero", "write x y z and angle");
    return turned(a[3] * unit, axis);
  }
  if (const auto e = numbers("euler", 3, 3); !e.empty()) return turned_by_euler(e);
  if (const auto xy = numbers("xyaxes", 6, 6); !xy.empty()) {
    const Vec3 x = Vec3(xy[0], xy[1], xy[2]).normalized();
    const Vec3 y = Vec3(xy[3], xy[4], xy[5]);
    const Vec3 square = (y - x * x.dot(y)).normalized();
    Mat3 out;
    out << x, square, x.cross(square);
    if (!out.allFinite() || std::abs(out.determinant() - 1) > 1e-6)
      element_.fail("xyaxes are no two axes", "write two axes that differ");
    return out;
  }
  const Vec3 z = vector("zaxis", Vec3::UnitZ());
  if (z.norm() < 1e-9) element_.fail("zaxis is zero", "write an axis");
  return Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), z).toRotationMatrix();
}

Transform Item::pose() const {
  Transform out = Transform::Identity();
  out.translation() = vector("pos", Vec3::Zero());
  out.linear() = rotation();
  return out;
}

Document::Document(const std::string& path) {
  read(path);
  const XmlElement main = root();
  if (main.name() != "mujoco")
    main.fail("this is <" + main.name() + ">, not <mujoco>", "give an MJCF file");
  read_includes(main, 0);
  for (const XmlElement& section : children(main)) {
    if (section.name() == "compiler") read_compiler(section);
    if (section.name() != "default") continue;
    if (classes_.empty()) main_ = section.text("class", main_);
    read_defaults(section, "");
  }
  classes_[main_];
}

XmlElement Document::root() const {
  return {files_.front()->path, *files_.front()->xml.RootElement()};
}

const Document::File& Document::read(const std::string& path) {
  files_.push_back(std::make_unique<File>());
  File& file = *files_.back();
  file.path = path;
  model::load_xml(path, file.xml);
  return file;
}

void Document::read_includes(const XmlElement& element, int depth) {
  for (const XmlElement& child : element.children()) {
    if (child.name() != "include") {
      read_includes(child, depth);
      continue;
    }
    const std::string name = child.text("file");
    if (depth == kMostDepth || files_.size() == kMostFiles)
      child.fail("the includes of '" + name + "' have no end", "remove the one that goes round");
    fs::path at = fs::path(child.file()).parent_path() / name;
    if (!fs::exists(at)) at = fs::path(path()).parent_path() / name;
    if (!fs::exists(at)) {
      missing_.push_back(name);
      continue;
    }
    const File& file = read(at.string());
    included_[&child.raw()] = &file;
    read_includes({file.path, *file.xml.RootElement()}, depth + 1);
  }
}

std::vector<XmlElement> Document::children(const XmlElement& element) const {
  std::vector<XmlElement> out;
  for (const XmlElement& child : element.children()) {
    const auto included = included_.find(&child.raw());
    if (included == included_.end()) {
      out.push_back(child);
      continue;
    }
    const File& file = *included->second;
    const auto inner = children({file.path, *file.xml.RootElement()});
    out.insert(out.end(), inner.begin(), inner.end());
  }
  return out;
}

std::vector<XmlElement> Document::all(const char* section) const {
  std::vector<XmlElement> out;
  for (const XmlElement& each : children(root())) {
    if (each.name() != section) continue;
    const auto inner = children(each);
    out.insert(out.end(), inner.begin(), inner.end());
  }
  return out;
}

void Document::read_defaults(const XmlElement& section, const std::string& parent) {
  const std::string name = section.text("class", parent.empty() ? main_ : "");
  if (name.empty()) section.fail("a <default> in another one has no class", "add class=\"NAME\"");
  Class& own = classes_[name];
  own.parent = parent;
  for (const XmlElement& child : children(section)) {
    if (child.name() == "default") {
      read_defaults(child, name);
      continue;
    }
    for (const auto* a = child.raw().FirstAttribute(); a != nullptr; a = a->Next())
      own.values[key_of(child.name())][a->Name()] = a->Value();
  }
}

std::optional<std::string> Document::preset(const XmlElement& element, const std::string& chosen,
                                            const char* attribute) const {
  std::string at = chosen.empty() ? main_ : chosen;
  if (classes_.count(at) == 0)
    element.fail("there is no class '" + at + "'", "add it to <default>, or correct the name");
  for (int depth = 0; !at.empty() && depth < kMostDepth; ++depth) {
    const Class& own = classes_.at(at);
    const auto values = own.values.find(key_of(element.name()));
    if (values != own.values.end()) {
      const auto value = values->second.find(attribute);
      if (value != values->second.end()) return value->second;
    }
    at = own.parent;
  }
  return std::nullopt;
}

void Document::read_compiler(const XmlElement& element) {
  const Item item(*this, element, "");
  const auto own = [&](const char* name, const std::string& fallback) {
    return element.text(name, fallback);
  };
  compiler_.degrees = own("angle", compiler_.degrees ? "degree" : "radian") == "degree";
  compiler_.euler = own("eulerseq", compiler_.euler);
  std::string letters = compiler_.euler;
  for (char& c : letters) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (letters.size() != 3 || letters.find_first_not_of("xyz") != std::string::npos)
    element.fail("eulerseq=\"" + compiler_.euler + "\" is no order of axes", "write it like xyz");
  compiler_.mesh_folder = own("meshdir", own("assetdir", compiler_.mesh_folder));
  compiler_.strips_paths = own("strippath", compiler_.strips_paths ? "true" : "") == "true";
  compiler_.all_from_geoms =
      own("inertiafromgeom", compiler_.all_from_geoms ? "true" : "auto") == "true";
  compiler_.total_mass_kg = element.number("settotalmass", compiler_.total_mass_kg);
  if (own("coordinate", "local") != "local")
    element.fail("coordinate=\"global\" is no longer MuJoCo's",
                 "save the file once with a newer MuJoCo");
}

}  // namespace verp::mjcf
