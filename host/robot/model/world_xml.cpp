#include "host/robot/model/world_xml.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "host/os/files/whole.hpp"
#include "host/robot/model/bounds.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/malformed_xml.hpp"
#include "host/robot/model/number.hpp"

namespace verp::model {
namespace {

constexpr double kMostWorld_m = 1000;
constexpr double kMostAnything = 1e12;

struct Leaf {
  std::size_t count;
  double low, high;
  const char* unit = "";
};
const std::map<std::string_view, Leaf> kLeaves = {
    {"gravity", {3, -100, 100, " m/s^2"}},
    {"pose", {6, -kMostWorld_m, kMostWorld_m}},
    {"mass", {1, kLeastMass_kg, kMostMass_kg, " kg"}},
    {"ixx", {1, 0, 1e5, " kg m^2"}},
    {"iyy", {1, 0, 1e5, " kg m^2"}},
    {"izz", {1, 0, 1e5, " kg m^2"}},
    {"ixy", {1, -1e5, 1e5, " kg m^2"}},
    {"ixz", {1, -1e5, 1e5, " kg m^2"}},
    {"iyz", {1, -1e5, 1e5, " kg m^2"}},
    {"normal", {3, -1, 1}},
    {"radius", {1, kLeastLength_m, kMostWorld_m, " m"}},
    {"length", {1, kLeastLength_m, kMostWorld_m, " m"}},
    {"scale", {3, -kMostWorld_m, kMostWorld_m}},
    {"mu", {1, 0, kMostFriction}},
    {"mu2", {1, 0, kMostFriction}},
    {"kp", {1, 1, kMostStiffness_n_m, " N/m"}},
    {"kd", {1, 0, kMostDamping_n_s_m, " N s/m"}},
    {"restitution_coefficient", {1, 0, 1}},
    {"transparency", {1, 0, 1}},
    {"range", {1, 0, kMostAnything}},
    {"constant", {1, 0, kMostAnything}},
    {"linear", {1, 0, kMostAnything}},
    {"quadratic", {1, 0, kMostAnything}},
    {"direction", {3, -kMostAnything, kMostAnything}},
    {"inner_angle", {1, 0, 3.15, " rad"}},
    {"outer_angle", {1, 0, 3.15, " rad"}},
    {"falloff", {1, 0, kMostAnything}},
    {"start", {1, 0, kMostAnything, " m"}},
    {"end", {1, 0, kMostAnything, " m"}},
    {"density", {1, 0, kMostAnything, " 1/m"}}};

bool is_color(std::string_view name) {
  return name == "ambient" || name == "diffuse" || name == "specular" || name == "emissive" ||
         name == "background" || name == "color";
}

std::vector<double> strict(const XmlElement& at, const std::string& text, std::size_t least,
                           std::size_t most) {
  const auto values = parse_numbers(text);
  if (values && values->size() >= least && values->size() <= most) return *values;
  at.fail("<" + at.name() + "> is not " + std::to_string(most) + " finite number" +
              (most > 1 ? "s" : "") + ": '" + text + "'",
          "write digits with a decimal point, like 0.125");
}

void check_world_leaf(const XmlElement& at, const std::string& text) {
  const std::string name = at.name();
  std::vector<double> values;
  Leaf leaf{0, 0, 1};
  if (is_color(name)) {
    values = strict(at, text, 3, 4);
  } else if (name == "size") {  // box: three, plane: two
    values = strict(at, text, 2, 3);
    leaf = {0, kLeastLength_m, 2 * kMostWorld_m, " m"};
  } else if (const auto found = kLeaves.find(name); found != kLeaves.end()) {
    leaf = found->second;
    values = strict(at, text, leaf.count, leaf.count);
  }
  for (const double value : values)
    require_within(at.file(), at.line(), "<" + name + ">", value, leaf.low, leaf.high, leaf.unit);
}

}  // namespace

WorldXml::WorldXml(const std::string& path) : path_(path) {
  const auto text = files::read(path);
  if (!text)
    throw LoadError(path, 1, "cannot read this file", "check the path and its permissions");
  text_ = parse_xml(path, *text, document_);
  const XmlElement root(path_, *document_.RootElement());
  const auto worlds = root.children("world");
  if (root.name() != "sdf") root.fail("<" + root.name() + "> is no SDF", "start with <sdf>");
  if (worlds.size() != 1) {
    root.fail("one <world> is needed, there are " + std::to_string(worlds.size()),
              "a world's file holds exactly one; a robot's file goes to `verp walk MODEL`");
  }
  world_ = &worlds.front().raw();
  inspect(*world_);
  blank_includes();
}

void WorldXml::inspect(const tinyxml2::XMLElement& element) {
  const XmlElement at(path_, element);
  const char* own = element.Attribute("name");
  if (own != nullptr) lines_.insert({own, element.GetLineNum()});
  // An empty pose is no pose; other empty elements would mean libsdformat's default: 1 kg for an
  // empty <mass>.
  const char* const text = element.GetText();
  if (element.FirstChildElement() == nullptr && (text != nullptr || at.name() != "pose"))
    check_world_leaf(at, text != nullptr ? text : "");
  for (const auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    inspect(*child);
  }
}

int WorldXml::line_of(const std::string& name) const {
  const auto found = lines_.find(name);
  return found == lines_.end() ? world_->GetLineNum() : found->second;
}

int WorldXml::blame(const std::string& message) const {
  constexpr std::string_view kDelimiters = "'\"[]<>:, .()";
  std::string_view rest = message;
  while (!rest.empty()) {
    const auto length = std::min(rest.find_first_of(kDelimiters), rest.size());
    const std::string word(rest.substr(0, length));
    if (length > 0 && lines_.contains(word)) return line_of(word);
    rest.remove_prefix(std::min(length + 1, rest.size()));
  }
  return world_->GetLineNum();
}

/// Blanks the word in comments, too, where nothing is lost.
void WorldXml::blank_includes() {
  constexpr std::string_view kBegin = "<include", kEnd = "</include>";
  std::size_t at = 0;
  while ((at = text_.find(kBegin, at)) != std::string::npos) {
    const std::size_t end = text_.find(kEnd, at);
    if (end == std::string::npos) return;
    for (; at < end + kEnd.size(); ++at) {
      if (text_[at] != '\n') text_[at] = ' ';
    }
  }
}

std::vector<WorldRobot> WorldXml::robots() const {
  std::vector<WorldRobot> robots;
  for (const XmlElement& include : world().children("include")) {
    const auto child = [&](const char* name) {
      const auto* found = include.raw().FirstChildElement(name);
      return std::string(found != nullptr && found->GetText() != nullptr ? found->GetText() : "");
    };
    WorldRobot robot{.name = child("name"), .file = child("uri")};
    if (robot.name.empty()) robot.name = "robot" + std::to_string(robots.size() + 1);
    for (const WorldRobot& other : robots) {
      if (other.name == robot.name)
        include.fail("a second robot '" + robot.name + "'",
                     "give each <include> a <name> of its own");
    }
    const std::string uri = robot.file;
    robot.file = resolve_model_uri(uri, path_);
    if (robot.file.empty()) {
      include.fail(
          "'" + uri + "' is no robot's file, neither beside this one nor in " + model_path_text(),
          "give the path of a robot.sdf from here");
    }
    if (const std::string pose = child("pose"); !pose.empty()) {
      const std::vector<double> value = *parse_numbers(pose);  // six: checked
      if (value[2] != 0 || value[3] != 0 || value[4] != 0)
        include.fail("a robot stands on the ground",
                     "give its <pose> x, y and yaw only: x y 0 0 0 yaw");
      robot.x_m = value[0], robot.y_m = value[1], robot.yaw_rad = value[5];
    }
    robots.push_back(std::move(robot));
  }
  return robots;
}

}  // namespace verp::model
