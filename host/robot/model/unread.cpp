#include "host/robot/model/unread.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "host/robot/model/number.hpp"

namespace verp::model {
namespace {

constexpr std::size_t kMostNames = 12;  // in one line

using ReadElements = std::map<std::string_view, std::string_view>;

/// Parents, and which of their children are read. Other parents are read as a whole.
const ReadElements kReadOfSdf = {{"model", " link joint frame include pose "},
                                 {"include", " uri name pose placement_frame "},
                                 {"link", " inertial collision visual sensor pose "},
                                 {"inertial", " mass inertia pose density "},
                                 {"collision", " geometry pose surface density "},
                                 {"surface", " friction contact "},
                                 {"friction", " ode "},
                                 {"contact", " ode "},
                                 {"ode", " mu mu2 kp kd "},
                                 {"visual", " geometry pose material "},
                                 {"geometry", " mesh box sphere cylinder capsule ellipsoid "},
                                 {"mesh", " uri scale "},
                                 {"joint", " parent child axis axis2 pose sensor "},
                                 {"axis", " xyz limit dynamics mimic use_parent_model_frame "},
                                 {"limit", " lower upper velocity effort "},
                                 {"dynamics", " damping friction "}};
const ReadElements kReadOfUrdf = {
    {"robot", " link joint material gazebo "},
    {"link", " inertial visual collision "},
    {"inertial", " origin mass inertia "},
    {"visual", " origin geometry material "},
    {"collision", " origin geometry "},
    {"geometry", " mesh box sphere cylinder "},
    {"joint", " origin parent child axis limit dynamics mimic "},
    {"gazebo", " sensor mu1 mu2 kp kd preserveFixedJoint disableFixedJointLumping "}};

/// Elements whose loss has words of its own.
const std::map<std::string_view, std::string_view> kWords = {
    {"gravity", "<gravity>0: gravity pulls at all links"},
    {"turnGravityOff", "<turnGravityOff>: gravity pulls at all links"},
    {"static", "<static>: the robot moves"},
    {"kinematic", "<kinematic> of links"},
    {"spring_stiffness", "springs of joints (spring_stiffness)"},
    {"springStiffness", "springs of joints (springStiffness)"},
    {"model", "models in the model, with their links"},
    {"gripper", "<gripper>"},
    {"light", "<light>"},
    {"particle_emitter", "<particle_emitter>"},
    {"plugin", "plugins"},
    {"safety_controller", "soft limits of joints (safety_controller): the controller has its own"}};

std::string own_name(const XmlElement& element) {
  for (const char* const each : {"name", "reference", "filename"}) {
    if (const char* const value = element.raw().Attribute(each)) return value;
  }
  return "";
}

/// The element's name, or that of the nearest element around it that has one.
std::string nearest_name(const XmlElement& element) {
  for (const auto* at = &element.raw(); at != nullptr; at = at->Parent()->ToElement()) {
    if (const std::string name = own_name({element.file(), *at}); !name.empty()) return name;
  }
  return "";
}

/// Exporters write such values for everything.
bool changes_nothing(const XmlElement& element) {
  if (element.name() == "spring_reference") return true;  // told with its stiffness
  if (!own_name(element).empty()) return false;
  const auto inner = element.children();
  if (!inner.empty()) return std::all_of(inner.begin(), inner.end(), changes_nothing);
  const char* const text = element.raw().GetText();
  if (text == nullptr) return false;
  const auto number = parse_number(text);
  const bool is_on = std::string_view(text) == "true" || number == 1;
  if (element.name() == "gravity") return is_on;
  return std::string_view(text) == "false" || number == 0;
}

bool merges(const XmlElement& include) {
  const char* const merge = include.raw().Attribute("merge");
  return merge != nullptr && (std::string_view(merge) == "true" || std::string_view(merge) == "1");
}

class UnreadFinder {
 public:
  UnreadFinder(Lost& lost, bool is_urdf) : lost_(lost), is_urdf_(is_urdf) {}

  void look_into(const XmlElement& parent) {
    if (is_urdf_) look_at_values(parent);
    const ReadElements& table = is_urdf_ ? kReadOfUrdf : kReadOfSdf;
    const auto row = table.find(parent.name());
    if (row == table.end()) return;
    for (const XmlElement& child : parent.children()) {
      if (row->second.find(" " + child.name() + " ") != std::string_view::npos) {
        look_into(child);
      } else if (child.name().find(':') == std::string::npos && !changes_nothing(child)) {
        tell(words_for(parent, child), child);
      }
      if (child.name() == "include" && !merges(child)) {
        tell("<include> without merge=\"true\": models in the model, with their links", child);
      }
    }
  }

  void tell(const std::string& what, const XmlElement& at) {
    lost_[what].push_back(nearest_name(at));
  }

  static std::string words_for(const XmlElement& parent, const XmlElement& child) {
    const auto own = kWords.find(child.name());
    if (own != kWords.end()) return std::string(own->second);
    if (parent.name() == "geometry") return "shapes of type " + child.name();
    if (parent.name() == "model" || parent.name() == "robot") return "<" + child.name() + ">";
    if (parent.name() == "link" || parent.name() == "joint" || parent.name() == "visual")
      return fmt::format("<{}> of {}s", child.name(), parent.name());
    return fmt::format("<{}> in <{}>", child.name(), parent.name());
  }

 private:
  /// Attributes of URDF whose value is not taken as it stands.
  void look_at_values(const XmlElement& element) {
    if (element.name() == "mimic") look_at_mimic(element);
    const char* const scale = element.raw().Attribute("scale");
    if (element.name() == "mesh" && scale != nullptr && parse_number(scale))
      tell("<mesh> scale of one number: taken for all three axes", element);
    if (element.name() != "limit") return;
    const auto number = [&](const char* attribute) {
      return parse_number(element.text(attribute, "")).value_or(1);
    };
    for (const char* const each : {"velocity", "effort"}) {
      if (element.has(each) && number(each) <= 0)
        tell(fmt::format("<limit> {} of zero or less: taken as not given", each), element);
    }
    if (element.has("lower") && element.has("upper") && number("lower") > number("upper"))
      tell("swapped lower and upper limits: taken in order", element);
  }

  void look_at_mimic(const XmlElement& mimic) {
    const std::string driver = mimic.text("joint", "");
    const auto* joint = mimic.raw().GetDocument()->RootElement()->FirstChildElement("joint");
    while (joint != nullptr && joint->Attribute("name", driver.c_str()) == nullptr)
      joint = joint->NextSiblingElement("joint");
    if (joint == nullptr)
      tell("<mimic> of joint '" + driver + "', which there is not: a servo turns it", mimic);
  }

  Lost& lost_;
  bool is_urdf_;
};

}  // namespace

void find_unread(const XmlElement& top, Lost& lost) {
  const std::string_view root = top.raw().GetDocument()->RootElement()->Name();
  UnreadFinder(lost, root == "robot").look_into(top);
}

void tell_unread(const XmlElement& parent, const XmlElement& child, Lost& lost) {
  UnreadFinder finder(lost, false);
  if (!changes_nothing(child)) finder.tell(UnreadFinder::words_for(parent, child), child);
}

void find_missing_meshes(const Entity& robot, Lost& lost) {
  for (const Node& node : robot.nodes) {
    for (const Visual& visual : node.visuals) {
      if (visual.shape == Visual::Shape::kMesh && visual.mesh.empty())
        lost[kMissingMeshes].push_back(visual.mesh_uri);
    }
  }
}

std::vector<std::string> lines_of(const Lost& lost) {
  std::vector<std::string> lines;
  for (const auto& [what, which] : lost) {
    std::vector<std::string> names;
    for (const std::string& each : which) {
      const bool is_new = std::find(names.begin(), names.end(), each) == names.end();
      if (!each.empty() && is_new) names.push_back(each);
    }
    const std::size_t count = names.size();
    if (count > kMostNames) {
      names.resize(kMostNames);
      names.push_back(fmt::format("and {} more", count - kMostNames));
    }
    lines.push_back(names.empty() ? what : fmt::format("{} ({})", what, fmt::join(names, ", ")));
  }
  return lines;
}

}  // namespace verp::model
