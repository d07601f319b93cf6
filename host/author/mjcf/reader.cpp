#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include "host/author/mjcf/attributes.hpp"
#include "host/author/mjcf/mjcf.hpp"
#include "host/author/mjcf/solids.hpp"
#include "host/author/mjcf/transmission.hpp"

namespace verp::mjcf {
namespace {

namespace fs = std::filesystem;

/// Bodies below the world, of which one is the robot.
class Reader {
 public:
  explicit Reader(const std::string& path) : document_(path) {}

  Robot read() {
    out_.name = document_.root().text("model", "robot");
    read_meshes();
    read_pairs();
    for (const XmlElement& section : document_.children(document_.root())) {
      if (section.name() == "worldbody") keep_joint_names(section);
      if (section.name() == "worldbody" || section.name() == "default") tell_attributes(section);
    }
    for (const XmlElement& section : document_.children(document_.root())) {
      if (section.name() == "worldbody") read_contents(section, "", Transform::Identity(), -1);
    }
    if (out_.bodies.empty())
      document_.root().fail("no <body> is in its <worldbody>", "give a robot's MJCF file");
    read_actuators();
    read_own_numbers();
    read_equalities();
    for (const std::string& each : move_motors(out_, closures_)) lose(each);
    read_sensors();
    read_keyframe();
    keep_the_robot();
    weigh();
    tell();
    return std::move(out_);
  }

 private:
  Item item(const XmlElement& element, const std::string& child_class = "") const {
    return {document_, element, child_class};
  }
  double angle_unit() const { return document_.compiler().degrees ? std::numbers::pi / 180 : 1; }
  void lose(const std::string& what) { ++lost_[what]; }

  void tell_attributes(const XmlElement& element) {
    for (const std::string& each : unknown_attributes(element))
      lose(fmt::format("the attribute {} of <{}>, which MJCF has not", each, element.name()));
    for (const XmlElement& inner : document_.children(element)) tell_attributes(inner);
  }

  void read_meshes() {
    for (const XmlElement& each : document_.all("asset")) {
      if (each.name() != "mesh") continue;
      const Item mesh = item(each);
      fs::path file = mesh.text("file");
      const std::string name = mesh.name().empty() ? file.stem().string() : mesh.name();
      if (document_.compiler().strips_paths) file = file.filename();
      const fs::path folder = fs::path(document_.path()).parent_path();
      out_.meshes[name] = {(folder / document_.compiler().mesh_folder / file).string(),
                           mesh.vector("scale", Vec3::Ones())};
    }
  }

  /// Geoms of pairs touch, whatever their masks say.
  void read_pairs() {
    for (const XmlElement& each : document_.all("contact")) {
      if (each.name() != "pair") continue;
      for (const char* const end : {"geom1", "geom2"}) paired_.insert(each.text(end, ""));
    }
  }

  /// The contents of a body, a <frame> in it, or the world (`body` -1).
  void read_contents(const XmlElement& element, const std::string& child_class,
                     const Transform& frame, int body) {
    for (const XmlElement& each : document_.children(element)) {
      const std::string kind = each.name();
      const Item inner = item(each, child_class);
      if (kind == "body") {
        read_body(inner, child_class, frame, body);
      } else if (kind == "frame") {
        read_contents(each, each.text("childclass", child_class), frame * inner.pose(), body);
      } else if (kind == "site") {
        if (!inner.name().empty()) sites_[inner.name()] = body;
      } else if (body < 0) {
        if (kind == "geom") lose("shapes of the world, such as its floor");
      } else {
        read_part(inner, kind, frame, body);
      }
    }
  }

  void read_part(const Item& part, const std::string& kind, const Transform& frame, int index) {
    Body& body = out_.bodies[static_cast<std::size_t>(index)];
    if (kind == "geom") {
      read_geom(part, frame, body);
    } else if (kind == "joint") {
      read_joint(part, frame, body);
    } else if (kind == "inertial") {
      read_inertial(part, frame, body);
    } else if (kind != "freejoint" && kind != "light" && kind != "camera") {
      lose("<" + kind + "> in bodies");
    }
  }

  void read_body(const Item& element, const std::string& child_class, const Transform& frame,
                 int parent) {
    if (!element.name().empty() && !body_names_.emplace(element.name(), out_.bodies.size()).second)
      element.element().fail("a second body is named '" + element.name() + "'", "rename one");
    Body body;
    body.name = free_name(element.name().empty() ? fmt::format("body_{}", out_.bodies.size())
                                                 : element.name());
    body.parent = parent;
    body.pose = frame * element.pose();
    out_.bodies.push_back(body);
    if (element.number("gravcomp", 0) != 0) lose("gravcomp of bodies");
    read_contents(element.element(), element.element().text("childclass", child_class),
                  Transform::Identity(), static_cast<int>(out_.bodies.size()) - 1);
  }

  /// Bodies make way: owners write joints' names.
  void keep_joint_names(const XmlElement& element) {
    for (const XmlElement& each : document_.children(element)) {
      if (each.name() == "joint") names_.insert(each.text("name", ""));
      keep_joint_names(each);
    }
  }

  /// A name that no body or joint has yet: libsdformat knows one space of names.
  std::string free_name(const std::string& wished) {
    std::string name = wished;
    for (int i = 2; !names_.insert(name).second; ++i)
      name = i == 2 ? wished + "_link" : fmt::format("{}_link_{}", wished, i);
    return name;
  }

  void read_joint(const Item& element, const Transform& frame, Body& body) {
    const std::string type = element.text("type", "hinge");
    if (type == "free") return;
    Joint joint;
    joint.slides = type == "slide";
    const std::string given = element.name().empty() ? body.name + "_joint" : element.name();
    if (type == "ball") {
      out_.left_out.push_back("joint " + given + " is a ball joint: it is fixed");
      return;
    }
    joint.name = element.name().empty() ? free_name(given) : given;
    if (!joint_names_.insert(joint.name).second)
      element.element().fail("a second joint is named '" + given + "'", "rename one");
    joint.at_m = frame * element.vector("pos", Vec3::Zero());
    joint.axis = frame.linear() * element.vector("axis", Vec3::UnitZ());
    if (joint.axis.norm() < 1e-9) element.element().fail("its axis is zero", "write an axis");
    joint.axis.normalize();
    const double unit = joint.slides ? 1 : angle_unit();
    const auto range = element.numbers("range", 2, 2);
    joint.has_stops = element.flag("limited").value_or(!range.empty()) && !range.empty();
    if (joint.has_stops) joint.lower = range[0] * unit, joint.upper = range[1] * unit;
    joint.start = element.number("ref", 0) * unit;
    joint.motor.armature_kg_m2 = element.number("armature", 0);
    joint.motor.damping_n_m_s = element.number("damping", 0);
    joint.motor.friction_n_m = element.number("frictionloss", 0);
    const auto force = element.numbers("actuatorfrcrange", 2, 2);
    if (!force.empty()) joint.motor.torque_n_m = std::max(std::abs(force[0]), std::abs(force[1]));
    if (element.number("stiffness", 0) != 0) lose("springs of joints (stiffness)");
    body.joints.push_back(joint);
  }

  static void read_inertial(const Item& element, const Transform& frame, Body& body) {
    Inertial own;
    own.mass_kg = element.number("mass", 0);
    own.pose = frame * element.pose();
    const auto full = element.numbers("fullinertia", 6, 6);
    const Vec3 diagonal = element.vector("diaginertia", Vec3::Zero());
    own.inertia_kg_m2 = diagonal.asDiagonal();
    if (!full.empty()) {
      own.inertia_kg_m2 << full[0], full[3], full[4], full[3], full[1], full[5], full[4], full[5],
          full[2];
    }
    if (own.mass_kg < 0) element.element().fail("its mass is negative", "correct it");
    body.inertial = own;
  }

  void read_geom(const Item& element, const Transform& frame, Body& body) {
    static const std::map<std::string, Geom::Kind> kKinds = {{"box", Geom::Kind::kBox},
                                                             {"sphere", Geom::Kind::kSphere},
                                                             {"cylinder", Geom::Kind::kCylinder},
                                                             {"capsule", Geom::Kind::kCapsule},
                                                             {"ellipsoid", Geom::Kind::kEllipsoid},
                                                             {"mesh", Geom::Kind::kMesh}};
    const std::string type = element.text("type", "sphere");
    const auto kind = kKinds.find(type);
    if (kind == kKinds.end()) return lose("shapes of type " + type);
    Geom geom;
    geom.kind = kind->second;
    geom.mesh = element.text("mesh");
    if (!geom.mesh.empty()) geom.kind = Geom::Kind::kMesh;
    geom.pose = frame * element.pose();
    if (geom.kind != Geom::Kind::kMesh) {
      read_size(element, frame, geom);
    } else if (out_.meshes.count(geom.mesh) == 0) {
      element.element().fail("there is no mesh '" + geom.mesh + "'", "add it to <asset>");
    }
    geom.mass_kg = element.number("mass", -1);
    geom.density_kg_m3 = element.number("density", 1000);
    const double mask = element.number("contype", 1) + element.number("conaffinity", 1);
    geom.touches = mask != 0 || paired_.count(element.name()) > 0;
    geom.is_seen = element.number("group", 0) < 3;
    geom.rgba = colour_of(element);
    body.geoms.push_back(geom);
  }

  std::vector<double> colour_of(const Item& geom) const {
    const auto own = geom.numbers("rgba", 4, 4);
    if (!own.empty()) return own;
    const std::string material = geom.text("material");
    for (const XmlElement& each : document_.all("asset")) {
      if (each.name() == "material" && each.text("name", "") == material)
        return item(each).numbers("rgba", 4, 4);
    }
    return {};
  }

  static void read_size(const Item& element, const Transform& frame, Geom& geom) {
    auto size = element.numbers("size", 1, 3);
    const auto ends = element.numbers("fromto", 6, 6);
    const bool is_long = geom.kind == Geom::Kind::kCapsule || geom.kind == Geom::Kind::kCylinder;
    std::size_t needed = geom.kind == Geom::Kind::kSphere ? 1 : is_long ? 2 : 3;
    if (!ends.empty() && !size.empty()) {
      const Vec3 from(ends[0], ends[1], ends[2]), to(ends[3], ends[4], ends[5]);
      geom.pose = Transform::Identity();
      geom.pose.translation() = (from + to) / 2;
      geom.pose.linear() =
          Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), to - from).toRotationMatrix();
      geom.pose = frame * geom.pose;
      size.resize(is_long ? 1 : 2, size.back());
      size.push_back((to - from).norm() / 2);
    }
    if (size.size() < needed || *std::min_element(size.begin(), size.end()) < 0) {
      element.element().fail(
          fmt::format("a {} needs {} sizes of 0 or more", element.text("type", "sphere"), needed),
          "write size");
    }
    size.resize(3, 0);
    geom.size = Vec3(size[0], size[1], size[2]);
  }

  Joint* joint_named(const std::string& name) {
    for (Body& body : out_.bodies) {
      for (Joint& joint : body.joints) {
        if (!name.empty() && joint.name == name) return &joint;
      }
    }
    return nullptr;
  }

  void read_actuators() {
    for (const XmlElement& each : document_.all("actuator")) {
      const Item actuator = item(each);
      const std::string name = actuator.text("joint", actuator.text("jointinparent"));
      Joint* const joint = joint_named(name);
      if (!name.empty() && joint == nullptr)
        each.fail("there is no joint '" + name + "'", "correct the name");
      if (joint == nullptr) {
        lose("actuators that turn no joint");
        continue;
      }
      read_actuator(actuator, joint->motor);
    }
  }

  void read_own_numbers() {
    for (const XmlElement& each : document_.all("custom")) {
      const std::string name = each.text("name", "");
      if (name.rfind(kNoLoad, 0) != 0) continue;
      Joint* const joint = joint_named(name.substr(std::string_view(kNoLoad).size()));
      if (joint != nullptr) joint->motor.no_load_rad_s = item(each).number("data", 0);
    }
  }

  static void read_actuator(const Item& actuator, Motor& motor) {
    const auto most = [&](const char* attribute) {
      const auto range = actuator.numbers(attribute, 2, 2);
      return range.empty() ? 0.0 : std::max(std::abs(range[0]), std::abs(range[1]));
    };
    const auto gears = actuator.numbers("gear", 1, 6);
    const double gear = gears.empty() ? 1 : std::abs(gears[0]);
    const std::string kind = actuator.element().name();
    motor.has_actuator = true;
    double force = most("forcerange");
    if (force <= 0 && kind == "motor") force = most("ctrlrange");
    if (force <= 0 && kind == "general") {
      const auto gain = actuator.numbers("gainprm", 1, 10);
      const auto bias = actuator.numbers("biasprm", 1, 10);
      const bool is_affine = actuator.text("biastype", "none") != "none" && bias.size() > 1;
      if (is_affine) motor.kp_n_m_rad = -bias[1] * gear;
      if (!is_affine) force = most("ctrlrange") * (gain.empty() ? 1 : std::abs(gain[0]));
    }
    if (kind == "position") motor.kp_n_m_rad = actuator.number("kp", 1) * gear;
    if (force > 0 && motor.torque_n_m <= 0) motor.torque_n_m = force * gear;
  }

  void read_equalities() {
    for (const XmlElement& each : document_.all("equality")) {
      const Item equality = item(each);
      if (!equality.flag("active").value_or(true)) continue;
      const Joint* const first = joint_named(equality.text("joint1"));
      const Joint* const second = joint_named(equality.text("joint2"));
      if (each.name() != "joint" || first == nullptr || second == nullptr) {
        lose("equality constraints other than between two joints: loops are open");
        closures_.push_back({end_of(each, "1"), end_of(each, "2")});
        continue;
      }
      auto terms = equality.numbers("polycoef", 1, 5);
      if (terms.empty()) terms = {0, 1};
      terms.resize(5, 0);
      if (terms[2] != 0 || terms[3] != 0 || terms[4] != 0)
        lose("terms of polycoef beyond the second");
      out_.followers.push_back({first->name, second->name,
                                terms[0] + first->start - terms[1] * second->start, terms[1]});
    }
  }

  /// Body of a constraint's body1 or site1; -1: the world, or none.
  int end_of(const XmlElement& constraint, const std::string& number) const {
    const auto body = body_names_.find(constraint.text(("body" + number).c_str(), ""));
    if (body != body_names_.end()) return static_cast<int>(body->second);
    const auto site = sites_.find(constraint.text(("site" + number).c_str(), ""));
    return site == sites_.end() ? -1 : site->second;
  }

  void read_sensors() {
    for (const XmlElement& each : document_.all("sensor")) {
      if (each.name() != "gyro" && each.name() != "accelerometer") continue;
      const auto site = sites_.find(each.text("site", ""));
      if (site != sites_.end() && site->second >= 0)
        out_.bodies[static_cast<std::size_t>(site->second)].has_imu = true;
    }
    if (!document_.all("tendon").empty()) lose("tendons");
  }

  /// The one named stand or home, else the first.
  void read_keyframe() {
    std::vector<XmlElement> keys = document_.all("keyframe");
    std::erase_if(keys, [](const XmlElement& key) { return !key.has("qpos"); });
    if (keys.empty()) return;
    const auto is_stand = [](const XmlElement& key) {
      const std::string name = key.text("name", "");
      return name.find("stand") != std::string::npos || name.find("home") != std::string::npos;
    };
    const auto chosen = std::find_if(keys.begin(), keys.end(), is_stand);
    const XmlElement key = chosen == keys.end() ? keys.front() : *chosen;
    const auto values = item(key).numbers("qpos", 1, 1000);
    std::size_t joints = 0;
    for (const Body& body : out_.bodies) joints += body.joints.size();
    if (values.size() != joints && values.size() != joints + 7) {
      return lose(
          fmt::format("keyframe '{}': its qpos has {} numbers, and the robot's would have {}",
                      key.text("name", ""), values.size(), joints + 7));
    }
    std::size_t at = values.size() - joints;
    for (const Body& body : out_.bodies) {
      for (const Joint& joint : body.joints) out_.stand[joint.name] = values[at++];
    }
  }

  std::vector<int> subtree(int root) const {
    std::vector<int> out = {root};
    for (std::size_t i = 0; i < out_.bodies.size(); ++i) {
      if (std::find(out.begin(), out.end(), out_.bodies[i].parent) != out.end())
        out.push_back(static_cast<int>(i));
    }
    return out;
  }

  std::size_t joints_below(int root) const {
    std::size_t count = 0;
    for (const int each : subtree(root))
      count += out_.bodies[static_cast<std::size_t>(each)].joints.size();
    return count;
  }

  /// Of the bodies of the world the one with most joints is the robot.
  void keep_the_robot() {
    std::vector<int> roots;
    for (std::size_t i = 0; i < out_.bodies.size(); ++i) {
      if (out_.bodies[i].parent < 0) roots.push_back(static_cast<int>(i));
    }
    const int root = *std::max_element(roots.begin(), roots.end(), [&](int a, int b) {
      return joints_below(a) < joints_below(b);
    });
    std::vector<std::string> others;
    for (const int each : roots) {
      if (each != root) others.push_back(out_.bodies[static_cast<std::size_t>(each)].name);
    }
    if (!others.empty())
      out_.left_out.push_back(fmt::format("bodies beside the robot: {}", fmt::join(others, ", ")));
    const std::vector<int> kept = subtree(root);
    std::vector<Body> bodies;
    std::map<int, int> place;
    for (const int each : kept) {
      place[each] = static_cast<int>(bodies.size());
      bodies.push_back(out_.bodies[static_cast<std::size_t>(each)]);
      Body& body = bodies.back();
      body.parent = each == root ? -1 : place.at(body.parent);
    }
    out_.bodies = bodies;
    Body& base = out_.bodies.front();
    if (!base.joints.empty()) {
      out_.left_out.push_back("joints between the world and the robot: it stands free");
      base.joints.clear();
    }
  }

  void weigh() {
    for (Body& body : out_.bodies) {
      if (!body.inertial || document_.compiler().all_from_geoms)
        body.inertial = inertial_of_geoms(body, out_);
    }
    const double wanted_kg = document_.compiler().total_mass_kg;
    double sum_kg = 0;
    for (const Body& body : out_.bodies) sum_kg += body.inertial ? body.inertial->mass_kg : 0;
    if (wanted_kg <= 0 || sum_kg <= 0) return;
    for (Body& body : out_.bodies) {
      if (!body.inertial) continue;
      body.inertial->mass_kg *= wanted_kg / sum_kg;
      body.inertial->inertia_kg_m2 *= wanted_kg / sum_kg;
    }
  }

  void tell() {
    for (const std::string& file : document_.missing())
      out_.left_out.push_back("the file " + file + ", which it includes, is not there");
    for (const auto& [what, count] : lost_) {
      out_.left_out.push_back(count == 1 ? what : fmt::format("{} ({} times)", what, count));
    }
  }

  Document document_;
  Robot out_;
  std::set<std::string> names_, joint_names_, paired_;
  std::map<std::string, std::size_t> body_names_;  ///< in the file
  std::map<std::string, int> sites_;               ///< body, by the site's name
  std::map<std::string, int> lost_;
  std::vector<Closure> closures_;
};

}  // namespace

Robot read_robot(const std::string& path) {
  return Reader(path).read();
}

}  // namespace verp::mjcf
