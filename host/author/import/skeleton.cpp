#include "host/author/import/skeleton.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "host/robot/model/load_error.hpp"
#include "host/robot/model/number.hpp"
#include "host/robot/model/principal.hpp"

namespace verp::import {
namespace {

using model::XmlElement;

std::optional<XmlElement> first(const XmlElement& parent, const char* name) {
  const auto found = parent.children(name);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

/// May be empty.
std::string words(const XmlElement& element, const char* attribute) {
  const char* const value = element.raw().Attribute(attribute);
  return value == nullptr ? "" : value;
}

Vec3 three(const XmlElement& element, const char* attribute, const Vec3& fallback) {
  const auto numbers = model::parse_numbers(words(element, attribute));
  if (!numbers || numbers->size() != 3) return fallback;
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

/// URDF's rpy: about fixed axes x, y, z.
Transform origin_of(const XmlElement& element) {
  Transform pose = Transform::Identity();
  const auto origin = first(element, "origin");
  if (!origin) return pose;
  const Vec3 rpy = three(*origin, "rpy", Vec3::Zero());
  pose.translation() = three(*origin, "xyz", Vec3::Zero());
  pose.linear() =
      (Eigen::AngleAxisd(rpy.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Vec3::UnitY()) *
       Eigen::AngleAxisd(rpy.x(), Vec3::UnitX()))
          .toRotationMatrix();
  return pose;
}

bool touches_a_mesh(const XmlElement& link) {
  for (const XmlElement& collision : link.children("collision")) {
    const auto geometry = first(collision, "geometry");
    if (geometry && first(*geometry, "mesh")) return true;
  }
  return false;
}

void read_moments(const XmlElement& inertia, LinkPart& link) {
  const auto at = [&](const char* each) { return inertia.number(each, 0); };
  model::Mat3 moments;
  moments << at("ixx"), at("ixy"), at("ixz"), at("ixy"), at("iyy"), at("iyz"), at("ixz"), at("iyz"),
      at("izz");
  const Vec3 principal = model::principal_moments(moments);
  link.radius_m = std::sqrt(principal.cwiseAbs().maxCoeff() / link.mass_kg);
  link.is_no_body = principal[0] <= 0 || principal[0] + principal[1] < principal[2] * (1 - 1e-6);
}

LinkPart link_of(const XmlElement& element) {
  LinkPart link;
  link.name = element.text("name");
  const auto inertial = first(element, "inertial");
  const auto mass = inertial ? first(*inertial, "mass") : std::nullopt;
  if (mass) link.mass_kg = mass->number("value", 0);
  const auto inertia = inertial ? first(*inertial, "inertia") : std::nullopt;
  if (inertia && link.mass_kg > 0) read_moments(*inertia, link);
  link.has_contact = first(element, "collision").has_value();
  link.has_shape = link.has_contact || first(element, "visual");
  link.has_mesh_contact = touches_a_mesh(element);
  return link;
}

Bone::Kind kind_of(const std::string& type) {
  if (type == "revolute" || type == "continuous") return Bone::Kind::kTurns;
  return type == "prismatic" ? Bone::Kind::kSlides : Bone::Kind::kFixed;
}

void read_limits(const XmlElement& joint, Bone& bone) {
  bone.has_no_stops = joint.text("type", "") == "continuous";
  const auto limit = first(joint, "limit");
  bone.lower_rad = 1;  // not given
  if (const auto dynamics = first(joint, "dynamics"))
    bone.has_friction = dynamics->number("friction", 0) > 0 || dynamics->number("damping", 0) > 0;
  if (limit) bone.limit.stall_torque_n_m = limit->number("effort", 0);
  if (limit) bone.limit.no_load_rad_s = limit->number("velocity", 0);
  if (!limit || bone.has_no_stops) return;
  bone.lower_rad = limit->number("lower", 0);
  bone.upper_rad = limit->number("upper", 0);
  if (limit->has("lower") && limit->has("upper") && bone.lower_rad > bone.upper_rad)
    std::swap(bone.lower_rad, bone.upper_rad);
}

class UrdfReader {
 public:
  explicit UrdfReader(const XmlElement& robot) : robot_(robot) {}

  Skeleton read() {
    bones_.name = robot_.text("name", "robot");
    for (const XmlElement& link : robot_.children("link")) {
      index_[link.text("name")] = static_cast<int>(bones_.links.size());
      bones_.links.push_back(link_of(link));
    }
    if (bones_.links.empty()) robot_.fail("there is no <link> in it", "give a robot's URDF");
    for (const XmlElement& joint : robot_.children("joint")) add(joint);
    find_sensors();
    find_root();
    place(bones_.root, Transform::Identity(), 0);
    for (const LinkPart& link : bones_.links) refuse_unreached(link);
    return std::move(bones_);
  }

 private:
  int link_at(const XmlElement& joint, const char* end) const {
    const auto element = first(joint, end);
    if (!element)
      joint.fail("joint '" + joint.text("name", "") + "' has no <" + end + ">", "add it");
    const auto found = index_.find(element->text("link"));
    if (found == index_.end()) {
      element->fail("there is no link '" + element->text("link") + "'", "name one that exists");
    }
    return found->second;
  }

  void add(const XmlElement& joint) {
    Bone bone;
    bone.name = joint.text("name");
    bone.kind = kind_of(joint.text("type", ""));
    bone.parent = link_at(joint, "parent");
    bone.child = link_at(joint, "child");
    bone.pose = origin_of(joint);
    if (const auto axis = first(joint, "axis")) bone.axis = three(*axis, "xyz", Vec3::UnitX());
    if (const auto mimic = first(joint, "mimic")) bone.follows = mimic->text("joint", "");
    read_limits(joint, bone);
    LinkPart& child = bones_.links[static_cast<std::size_t>(bone.child)];
    if (child.above >= 0) {
      joint.fail("link '" + child.name + "' hangs on two joints", "a robot is a tree: remove one");
    }
    child.above = static_cast<int>(bones_.bones.size());
    bones_.bones.push_back(bone);
  }

  /// <gazebo reference="LINK or JOINT"><sensor>
  void find_sensors() {
    for (const XmlElement& gazebo : robot_.children("gazebo")) {
      const std::string on = words(gazebo, "reference");
      for (const XmlElement& sensor : gazebo.children("sensor")) {
        const std::string type = sensor.text("type", "");
        const auto link = index_.find(on);
        if (type == "imu" && link != index_.end())
          bones_.links[static_cast<std::size_t>(link->second)].has_imu = true;
        const bool is_fixed = std::any_of(
            bones_.bones.begin(), bones_.bones.end(),
            [&](const Bone& bone) { return bone.name == on && bone.kind == Bone::Kind::kFixed; });
        if (scans_planes(sensor) || (type == "force_torque" && is_fixed))
          bones_.sensors_to_drop.push_back(sensor.text("name", ""));
      }
    }
  }

  static bool scans_planes(const XmlElement& sensor) {
    for (const char* const kind : {"ray", "lidar"}) {
      const auto laser = first(sensor, kind);
      const auto scan = laser ? first(*laser, "scan") : std::nullopt;
      if (scan && first(*scan, "vertical")) return true;
    }
    return false;
  }

  void find_root() {
    bones_.root = -1;
    for (std::size_t i = 0; i < bones_.links.size(); ++i) {
      if (bones_.links[i].above >= 0) continue;
      if (bones_.root >= 0) {
        robot_.fail("two root links: '" + bones_.links[static_cast<std::size_t>(bones_.root)].name +
                        "' and '" + bones_.links[i].name + "'",
                    "add the joint that carries one of them");
      }
      bones_.root = static_cast<int>(i);
    }
    if (bones_.root < 0) robot_.fail("its joints form a loop", "correct their parents");
  }

  void place(int link, const Transform& pose, int depth) {
    bones_.links[static_cast<std::size_t>(link)].pose = pose;
    if (depth > static_cast<int>(bones_.links.size())) return;
    for (Bone& bone : bones_.bones) {
      if (bone.parent != link) continue;
      bone.pose = pose * bone.pose;
      const Vec3 axis = bone.pose.linear() * bone.axis;
      bone.axis = axis.norm() > 0 ? Vec3(axis.normalized()) : Vec3(Vec3::UnitX());
      place(bone.child, bone.pose, depth + 1);
    }
    reached_.push_back(link);
  }

  void refuse_unreached(const LinkPart& link) const {
    const int at = index_.at(link.name);
    if (std::find(reached_.begin(), reached_.end(), at) != reached_.end()) return;
    robot_.fail("link '" + link.name + "' hangs on itself", "correct its joint's <parent>");
  }

  const XmlElement& robot_;
  Skeleton bones_;
  std::map<std::string, int> index_;
  std::vector<int> reached_;
};

}  // namespace

double Skeleton::mass_kg() const {
  double sum = 0;
  for (const LinkPart& link : links) sum += link.mass_kg;
  return sum;
}

std::vector<int> Skeleton::turning_to(int link) const {
  std::vector<int> path;
  for (int above = links[static_cast<std::size_t>(link)].above; above >= 0;) {
    const Bone& bone = bones[static_cast<std::size_t>(above)];
    if (bone.kind == Bone::Kind::kTurns) path.insert(path.begin(), above);
    above = links[static_cast<std::size_t>(bone.parent)].above;
  }
  return path;
}

std::vector<int> Skeleton::hanging_on(int link) const {
  std::vector<int> found = {link};
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const Bone& bone : bones) {
      if (bone.parent == found[i]) found.push_back(bone.child);
    }
  }
  return found;
}

Skeleton skeleton_of_urdf(const XmlElement& robot) {
  return UrdfReader(robot).read();
}

}  // namespace verp::import
