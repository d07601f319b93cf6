#include "host/author/plain_sdf/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/malformed_xml.hpp"
#include "host/robot/model/number.hpp"
#include "host/robot/model/xml_numbers.hpp"

namespace verp::plain_sdf {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kMostFiles = 256;  // more is a loop

std::string trimmed(const char* text) {
  const std::string all = text == nullptr ? "" : text;
  const auto begin = all.find_first_not_of(" \t\r\n");
  if (begin == all.npos) return "";
  return all.substr(begin, all.find_last_not_of(" \t\r\n") + 1 - begin);
}

[[noreturn]] void fail_at_leaf(const XmlElement& leaf, const std::string& text,
                               const std::string& what) {
  leaf.fail(fmt::format("<{}> is not {}: '{}'", leaf.name(), what, text), "correct it");
}

/// Numbers within the bounds of their element.
std::vector<double> numbers_of(const XmlElement& leaf, const std::string& text) {
  model::check_leaf(leaf.file(), leaf.line(), leaf.name(), text, false);
  const auto found = model::parse_numbers(text);
  if (!found) fail_at_leaf(leaf, text, "finite numbers");
  return *found;
}

model::Mat3 turn_of(const XmlElement& pose, const std::vector<double>& n) {
  if (n.size() == 7) {
    return Eigen::Quaterniond(n[6], n[3], n[4], n[5]).normalized().toRotationMatrix();
  }
  const bool degrees = pose.text("degrees", "false") == "true" || pose.text("degrees", "") == "1";
  const double unit = degrees ? std::numbers::pi / 180 : 1;
  return (Eigen::AngleAxisd(n[5] * unit, Vec3::UnitZ()) *
          Eigen::AngleAxisd(n[4] * unit, Vec3::UnitY()) *
          Eigen::AngleAxisd(n[3] * unit, Vec3::UnitX()))
      .toRotationMatrix();
}

/// The file of a model's folder: that of model.config with the highest version, or model.sdf.
std::string file_in_folder(const fs::path& folder) {
  std::error_code error;
  tinyxml2::XMLDocument config;
  fs::path best = folder / "model.sdf";
  double best_version = -1;
  if (config.LoadFile((folder / "model.config").c_str()) == tinyxml2::XML_SUCCESS) {
    const auto* root = config.RootElement();
    for (const auto* sdf = root ? root->FirstChildElement("sdf") : nullptr; sdf != nullptr;
         sdf = sdf->NextSiblingElement("sdf")) {
      const double version = sdf->DoubleAttribute("version", 0);
      const fs::path file = folder / trimmed(sdf->GetText());
      if (version <= best_version || !fs::is_regular_file(file, error)) continue;
      best = file, best_version = version;
    }
  }
  return fs::is_regular_file(best, error) ? best.string() : "";
}

}  // namespace

std::optional<XmlElement> first(const XmlElement& parent, const char* child) {
  const auto* found = parent.raw().FirstChildElement(child);
  if (found == nullptr) return std::nullopt;
  return XmlElement(parent.file(), *found);
}

std::string text_in(const XmlElement& parent, const char* child) {
  const auto* found = parent.raw().FirstChildElement(child);
  return found == nullptr ? "" : trimmed(found->GetText());
}

bool flag_in(const XmlElement& parent, const char* child) {
  const std::string text = text_in(parent, child);
  return text == "true" || text == "1" || text == "True" || text == "TRUE";
}

double number_in(const XmlElement& parent, const char* child, double fallback) {
  const auto leaf = first(parent, child);
  if (!leaf) return fallback;
  const std::string text = text_in(parent, child);
  const auto numbers = numbers_of(*leaf, text);
  if (numbers.size() != 1) fail_at_leaf(*leaf, text, "one number");
  return numbers[0];
}

double free_number_in(const XmlElement& parent, const char* child, double fallback) {
  const auto leaf = first(parent, child);
  const std::string text = text_in(parent, child);
  if (!leaf || text.empty()) return fallback;
  if (model::is_infinity(text))
    return std::copysign(std::numeric_limits<double>::infinity(), text[0] == '-' ? -1 : 1);
  const auto number = model::parse_number(text);
  if (!number) fail_at_leaf(*leaf, text, "a number");
  return *number;
}

Vec3 vector_in(const XmlElement& parent, const char* child, const Vec3& fallback) {
  const auto leaf = first(parent, child);
  if (!leaf) return fallback;
  const std::string text = text_in(parent, child);
  const auto numbers = numbers_of(*leaf, text);
  if (numbers.size() != 3) fail_at_leaf(*leaf, text, "three numbers");
  return {numbers[0], numbers[1], numbers[2]};
}

Transform pose_in(const XmlElement& parent) {
  Transform out = Transform::Identity();
  const auto pose = first(parent, "pose");
  const std::string text = text_in(parent, "pose");
  if (!pose || text.empty()) return out;
  const auto numbers = numbers_of(*pose, text);
  const bool turns_by_quaternion = pose->text("rotation_format", "") == "quat_xyzw";
  if (numbers.size() != (turns_by_quaternion ? 7 : 6))
    fail_at_leaf(*pose, text, turns_by_quaternion ? "seven numbers" : "six numbers");
  out.translation() = Vec3(numbers[0], numbers[1], numbers[2]);
  out.linear() = turn_of(*pose, numbers);
  return out;
}

std::string frame_of_pose(const XmlElement& parent) {
  const auto* pose = parent.raw().FirstChildElement("pose");
  if (pose == nullptr) return "";
  for (const char* const name : {"relative_to", "frame"}) {  // before SDF 1.7: frame
    if (const char* const value = pose->Attribute(name)) return value;
  }
  return "";
}

Document::Document(const std::string& path) {
  read(path);
  if (root().name() != "sdf")
    root().fail("this is <" + root().name() + ">, not <sdf>", "give a robot's SDF file");
}

XmlElement Document::root() const {
  return {files_.front()->path, *files_.front()->xml.RootElement()};
}

Document::File& Document::read(const std::string& path) {
  files_.push_back(std::make_unique<File>());
  File& file = *files_.back();
  file.path = path;
  model::load_xml(path, file.xml);
  const char* const version = file.xml.RootElement()->Attribute("version");
  file.version = model::parse_number(version == nullptr ? "" : version).value_or(1.6);
  // 1.10 and 1.11 are numbers after the dot.
  if (version != nullptr && std::string(version).starts_with("1.1") &&
      std::string(version) != "1.1")
    file.version = 2;
  return file;
}

double Document::version_of(const XmlElement& element) const {
  for (const auto& file : files_) {
    if (&file->path == &element.file()) return file->version;
  }
  return 2;
}

std::string Document::model_file(const std::string& uri, const std::string& from) const {
  const std::size_t scheme = uri.find("://");
  const std::string path = scheme == uri.npos ? uri : uri.substr(scheme + 3);
  std::vector<fs::path> places;
  std::error_code error;
  if (scheme == uri.npos || uri.starts_with("model://") || uri.starts_with("package://")) {
    for (fs::path folder = fs::absolute(from, error).parent_path();;
         folder = folder.parent_path()) {
      places.push_back(folder / path);
      if (scheme != uri.npos) places.push_back(folder / "models" / path);
      if (scheme == uri.npos || folder == folder.root_path() || folder.empty()) break;
    }
    for (const std::string& folder : model::model_path()) places.push_back(fs::path(folder) / path);
  } else if (uri.starts_with("file://")) {
    places = {path, fs::absolute(from, error).parent_path() / path};
  }
  for (const fs::path& place : places) {
    if (path.empty()) break;
    if (fs::is_regular_file(place, error)) return place.string();
    if (!fs::is_directory(place, error)) continue;
    if (const std::string file = file_in_folder(place); !file.empty()) return file;
  }
  return "";
}

std::optional<XmlElement> Document::included(const XmlElement& include) {
  const std::string uri = text_in(include, "uri");
  const std::string path = model_file(uri, include.file());
  if (path.empty()) return std::nullopt;
  if (files_.size() == kMostFiles)
    include.fail("the includes of '" + uri + "' have no end", "remove the one that goes round");
  const File& file = read(path);
  const XmlElement root(file.path, *file.xml.RootElement());
  if (root.name() == "robot") {
    include.fail("'" + uri + "' is URDF, and all that `verp import` needs",
                 "import that file: verp import " + path);
  }
  const auto model = first(root, "model");
  if (!model && (first(root, "actor") || first(root, "light"))) return std::nullopt;
  if (!model) include.fail("'" + uri + "' has no <model>", "correct its <uri>");
  return model;
}

std::string Document::picture(const std::string& uri, const XmlElement& at) const {
  std::vector<std::string> files = {at.file()};
  for (const auto& file : files_) files.push_back(file->path);
  std::string found = model::PictureFiles(files).find(uri);
  // A model's folder often has another name here than its maker gave it.
  const std::size_t name = uri.starts_with("model://") ? uri.find('/', 8) : uri.npos;
  if (found.empty() && name != uri.npos)
    found = model::PictureFiles({at.file()}).find(uri.substr(name + 1));
  return found;
}

}  // namespace verp::plain_sdf
