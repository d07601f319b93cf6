#include "host/robot/model/xml_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <string_view>

#include "host/os/files/whole.hpp"
#include "host/robot/model/bounds.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/malformed_xml.hpp"
#include "host/robot/model/number.hpp"
#include "host/robot/model/xml_numbers.hpp"

namespace verp::model {
namespace {

// Files that include two others each reach this at once.
constexpr std::size_t kMostFiles = 64;

// Per parent and kind; hands with sensors in every finger have hundreds of links.
constexpr std::size_t kMostElements = 1000;

constexpr const char* kNamespace = "https://verp.dev/sdf/1";

/// XML 1.0, 2.5: no "--" within a comment and no end in "--->"; tinyxml2 accepts both, other tools
/// do not.
class CommentCheck : public tinyxml2::XMLVisitor {
 public:
  explicit CommentCheck(const std::string& path) : path_(path) {}
  bool Visit(const tinyxml2::XMLComment& comment) override {
    const std::string text = std::string(comment.Value()) + '-';  // the comment's end counts as one
    const auto at = text.find("--");
    if (at == std::string::npos) return true;
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(at);
    throw LoadError(
        path_, comment.GetLineNum() + static_cast<int>(std::count(text.begin(), end, '\n')),
        "two hyphens inside a comment: not well-formed XML", "write the comment without \"--\"");
  }

 private:
  const std::string& path_;
};

/// Libraries silently take one of several.
void refuse_repeats(const std::string& path, const tinyxml2::XMLElement& element) {
  for (const char* once :
       {"mass", "inertia", "inertial", "pose", "axis", "limit", "parent", "child", "origin",
        "geometry", "xyz", "lower", "upper", "effort", "velocity", "size", "radius", "length"}) {
    const auto* first = element.FirstChildElement(once);
    const auto* second = first ? first->NextSiblingElement(once) : nullptr;
    if (second == nullptr) continue;
    throw LoadError(path, second->GetLineNum(),
                    "<" + std::string(once) + "> is given twice in <" + element.Name() +
                        "> (first in line " + std::to_string(first->GetLineNum()) + ")",
                    "keep one of them");
  }
}

/// libsdformat reports an invalid type without the joint's name.
void check_joint_type(const std::string& path, const tinyxml2::XMLElement& joint) {
  const std::string_view type = joint.Attribute("type") ? joint.Attribute("type") : "";
  for (const std::string_view known : {"revolute", "fixed", "continuous", "prismatic", "ball",
                                       "screw", "universal", "gearbox", "revolute2"}) {
    if (type == known) return;
  }
  throw LoadError(path, joint.GetLineNum(), "there is no joint type '" + std::string(type) + "'",
                  "write revolute, or fixed");
}

/// Lines must stay. libsdformat looks for other paths in places that we do not choose.
std::string name_of_include(const std::string& uri) {
  return fmt::format("verp-include-{:016x}", std::hash<std::string>{}(uri));
}

/// Called before the code visits each child.
void refuse_many(const std::string& path, const tinyxml2::XMLElement& element) {
  std::map<std::string_view, std::size_t> count;
  for (const auto* child = element.FirstChildElement(); child;
       child = child->NextSiblingElement()) {
    if (++count[child->Name()] <= kMostElements) continue;
    throw LoadError(path, child->GetLineNum(),
                    "more than " + std::to_string(kMostElements) + " <" + child->Name() + "> in <" +
                        element.Name() + ">",
                    "a robot has at most 32 joints: leave out what is none of it");
  }
  const auto* model = element.FirstChildElement("model");
  if (model) refuse_many(path, *model);
}

}  // namespace

std::vector<XmlElement> XmlElement::children() const {
  std::vector<XmlElement> found;
  for (const auto* child = element_->FirstChildElement(); child;
       child = child->NextSiblingElement()) {
    found.emplace_back(*file_, *child);
  }
  return found;
}

std::vector<XmlElement> XmlElement::children(const char* name) const {
  std::vector<XmlElement> found = children();
  std::erase_if(found, [&](const XmlElement& child) { return child.name() != name; });
  return found;
}

void XmlElement::fail(const std::string& message, const std::string& fix) const {
  throw LoadError(file(), line(), message, fix);
}

void XmlElement::allow(std::initializer_list<const char*> attributes,
                       std::initializer_list<const char*> elements) const {
  const auto among = [](std::initializer_list<const char*> names, const char* name) {
    const auto same = [&](const char* each) { return std::strcmp(each, name) == 0; };
    return std::any_of(names.begin(), names.end(), same);
  };
  for (const auto* a = element_->FirstAttribute(); a; a = a->Next()) {
    if (among(attributes, a->Name())) continue;
    std::string list;
    for (const char* name : attributes) list += std::string(list.empty() ? "" : ", ") + name;
    fail("<" + name() + "> has no attribute '" + a->Name() + "'", "it may have: " + list);
  }
  for (const XmlElement& child : children()) {
    if (among(elements, child.name().c_str())) continue;
    std::string list;
    for (const char* name : elements) list += std::string(list.empty() ? "<" : ", <") + name + ">";
    child.fail("unknown element <" + child.name() + "> in <" + name() + ">",
               list.empty() ? "it holds attributes only" : "it holds " + list + " only");
  }
  for (const auto* inside = element_->FirstChild(); inside; inside = inside->NextSibling()) {
    if (inside->ToText() == nullptr) continue;
    std::string word;  // first of many lines
    std::istringstream(inside->Value()) >> word;
    fail("<" + name() + "> has text inside, '" + word.substr(0, 40) + "', which nobody reads",
         "leave it out");
  }
}

std::string XmlElement::text(const char* attribute) const {
  const char* value = element_->Attribute(attribute);
  if (!value || !*value) {
    fail("<" + name() + "> lacks the attribute '" + attribute + "'",
         "add " + std::string(attribute) + "=\"...\"");
  }
  return value;
}

std::string XmlElement::text(const char* attribute, const std::string& fallback) const {
  return has(attribute) ? text(attribute) : fallback;
}

double XmlElement::number(const char* attribute) const {
  const std::string value = text(attribute);
  require_numbers(file(), line(), "<" + name() + "> " + attribute, value, 1);
  return *parse_number(value);
}

double XmlElement::number(const char* attribute, double fallback) const {
  return has(attribute) ? number(attribute) : fallback;
}

double XmlElement::number_within(const char* attribute, double low, double high,
                                 const char* unit) const {
  const double value = number(attribute);
  require_within(file(), line(), "<" + name() + "> " + attribute, value, low, high, unit);
  return value;
}

double XmlElement::number_within(const char* attribute, double low, double high, const char* unit,
                                 double fallback) const {
  return has(attribute) ? number_within(attribute, low, high, unit) : fallback;
}

int XmlElement::integer(const char* attribute, int lowest, int highest) const {
  const double value = number(attribute);
  if (value != std::floor(value) || value < lowest || value > highest) {
    fail("<" + name() + "> " + attribute + " is not a whole number from " + std::to_string(lowest) +
             " to " + std::to_string(highest) + ": '" + text(attribute) + "'",
         "choose one in that range");
  }
  return static_cast<int>(value);
}

int XmlElement::integer(const char* attribute, int lowest, int highest, int fallback) const {
  return has(attribute) ? integer(attribute, lowest, highest) : fallback;
}

Vec3 XmlElement::vector(const char* attribute) const {
  const std::string value = text(attribute);
  require_numbers(file(), line(), "<" + name() + "> " + attribute, value, 3);
  const auto numbers = *parse_numbers(value);
  return {numbers[0], numbers[1], numbers[2]};
}

XmlSource::XmlSource(const std::string& path, const std::optional<std::string>& text) {
  text_ = read(path, text);
}

std::string XmlSource::read(const std::string& path, const std::optional<std::string>& text) {
  if (!text && !std::ifstream(path)) {
    throw LoadError(path, 1, "cannot read this file", "check the path and its permissions");
  }
  files_.push_back(std::make_unique<File>());
  File& file = *files_.back();
  file.path = path;
  const std::string bytes = text ? *text : files::read(path).value_or("");
  std::string utf8 = parse_xml(path, bytes, file.document);
  const std::string root = file.document.RootElement()->Name();
  if (root != "sdf" && root != "robot") {
    throw LoadError(path, file.document.RootElement()->GetLineNum(),
                    "<" + root + "> is neither SDF nor URDF",
                    "a robot's file starts with <sdf version=\"1.9\">");
  }
  // libsdformat reads an included SDF itself.
  if (files_.size() > 1 && root == "sdf" && utf8 != bytes)
    throw LoadError(path, 1, "an included SDF file is no UTF-8", "save it as UTF-8");
  refuse_many(path, *file.document.RootElement());
  // Included files are often third-party files, used unchanged.
  if (files_.size() == 1) {
    CommentCheck comments(path);
    file.document.Accept(&comments);
  }
  open_.push_back(std::filesystem::weakly_canonical(path));
  inspect(file, *file.document.RootElement());
  open_.pop_back();
  return utf8;
}

void XmlSource::include(const File& file, const tinyxml2::XMLElement& element) {
  const int line = element.GetLineNum();
  const auto* uri = element.FirstChildElement("uri");
  const std::string text = uri && uri->GetText() ? uri->GetText() : "";
  const std::string found = resolve_model_uri(text, file.path);
  if (found.empty()) {
    if (text.starts_with("model://")) {
      throw LoadError(file.path, line, "'" + text + "' is not in " + model_path_text(),
                      "set VERP_MODEL_PATH to the folder that model:// names start in");
    }
    const auto folder = std::filesystem::absolute(file.path).parent_path();
    throw LoadError(file.path, line, "'" + text + "' is not in " + folder.string(),
                    "give the path from this file's folder, or a model:// name");
  }
  if (std::find(open_.begin(), open_.end(), std::filesystem::weakly_canonical(found)) !=
      open_.end()) {
    throw LoadError(file.path, line, "'" + text + "' includes itself",
                    "remove this <include>, or the one that leads here");
  }
  if (files_.size() == kMostFiles) {
    throw LoadError(file.path, line,
                    "more than " + std::to_string(kMostFiles) + " files are included",
                    "write what repeats into the robot's own file");
  }
  // libsdformat asks with this text, without saying for which file.
  const std::string whole = std::filesystem::weakly_canonical(found).string();
  const auto [same, is_new] = included_.insert({text, whole});
  if (!is_new && same->second != whole) {
    throw LoadError(file.path, line, "'" + text + "' is " + same->second + " for another file",
                    "give one of the two files another name");
  }
  read(found);
}

std::string XmlSource::included(const std::string& uri) const {
  for (const auto& [each, file] : included_) {
    if (each == uri || name_of_include(each) == uri) return file;
  }
  return "";
}

std::string XmlSource::text_with_names() const {
  std::string text = text_;
  for (std::size_t at = text.find("<uri>"); at != text.npos; at = text.find("<uri>", at + 1)) {
    const std::size_t begin = at + 5, end = text.find("</uri>", begin);
    if (end == text.npos) break;
    tinyxml2::XMLDocument element;  // the text may be escaped
    element.Parse(text.substr(at, end + 6 - at).c_str());
    const char* const uri = element.RootElement() ? element.RootElement()->GetText() : nullptr;
    if (uri != nullptr && included_.contains(uri))
      text.replace(begin, end - begin, name_of_include(uri));
  }
  return text;
}

void XmlSource::inspect(const File& file, const tinyxml2::XMLElement& element) {
  const std::string_view name = element.Name();
  const int line = element.GetLineNum();
  const bool is_urdf = std::string_view(file.document.RootElement()->Name()) == "robot";
  if (const char* own = element.Attribute("name"); own && !name.starts_with("verp:")) {
    names_.insert({own, {file.path, line}});
  }
  if (is_urdf) {
    for (const auto* a = element.FirstAttribute(); a; a = a->Next()) {
      check_urdf_attribute(file.path, line, std::string(name), a->Name(), a->Value());
    }
  }
  const char* const text = element.GetText();
  if (!element.FirstChildElement() && (text || !is_urdf)) {
    check_leaf(file.path, line, std::string(name), text ? text : "", is_urdf);
  }
  refuse_repeats(file.path, element);
  if (!is_urdf && name == "joint") check_joint_type(file.path, element);
  const std::string_view flag = text ? text : "";
  if (!is_urdf && name == "gravity" && (flag == "0" || flag == "false")) {
    throw LoadError(file.path, line, "gravity pulls at every link here, also at this one",
                    "leave <gravity> out");
  }
  if (!is_urdf && name == "include") include(file, element);
  for (const auto* child = element.FirstChildElement(); child;
       child = child->NextSiblingElement()) {
    inspect(file, *child);
  }
}

XmlElement XmlSource::model() const {
  const XmlElement root(files_.front()->path, *files_.front()->document.RootElement());
  const auto models = root.children("model");
  if (root.name() == "robot") {
    root.fail("this is a bare URDF: it says nothing about servos, limbs and sensors",
              "`verp import FILE` makes the robot.sdf that it needs");
  }
  const std::string version = root.text("version");
  if (!version.starts_with("1.") || parse_number(version).value_or(2) > 1.9) {
    root.fail("SDF " + version + " is not known here", "write <sdf version=\"1.9\">");
  }
  if (root.text("xmlns:verp", "") != kNamespace) {
    root.fail(root.has("xmlns:verp") ? "xmlns:verp is '" + root.text("xmlns:verp") + "'"
                                     : "xmlns:verp is missing",
              "write <sdf version=\"1.9\" xmlns:verp=\"" + std::string(kNamespace) + "\">");
  }
  if (models.size() != 1) {
    root.fail("one <model> is needed, there are " + std::to_string(models.size()),
              "a robot's file holds exactly one robot");
  }
  return models.front();
}

std::vector<XmlElement> XmlSource::urdfs() const {
  std::vector<XmlElement> found;
  for (const auto& file : files_) {
    const XmlElement root(file->path, *file->document.RootElement());
    if (root.name() == "robot") found.push_back(root);
  }
  return found;
}

std::vector<XmlElement> XmlSource::tops() const {
  std::vector<XmlElement> found = urdfs();
  for (const auto& file : files_) {
    const XmlElement root(file->path, *file->document.RootElement());
    for (const XmlElement& model : root.children("model")) found.push_back(model);
  }
  return found;
}

std::optional<XmlSource::Place> XmlSource::find(const std::string& name) const {
  const auto place = names_.find(name);
  if (place == names_.end()) return std::nullopt;
  return place->second;
}

XmlSource::Place XmlSource::blame(const std::string& message) const {
  constexpr std::string_view kDelimiters = "'\"[]<>:, .()";
  std::string_view rest = message;
  while (!rest.empty()) {
    const auto length = std::min(rest.find_first_of(kDelimiters), rest.size());
    const bool scope = rest.substr(length).starts_with("::");  // not the name itself
    if (length > 0 && !scope) {
      if (const auto place = find(std::string(rest.substr(0, length)))) return *place;
    }
    rest.remove_prefix(std::min(length + 1, rest.size()));
  }
  return {path(), files_.front()->document.RootElement()->GetLineNum()};
}

}  // namespace verp::model
