#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/author/mjcf/words.hpp"
#include "host/os/files/markup_text.hpp"

namespace verp::mjcf {
namespace {

using files::markup_text;

constexpr double kShare = 0.05;  // of a body's mass for each link between its joints
// An ellipsoid's box of the same volume: cube root of pi / 6.
constexpr double kBoxOfEllipsoid = 0.806;

std::string origin(const Transform& pose) {
  const Mat3 r = pose.linear();
  const double pitch = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  const bool is_upright = std::hypot(r(0, 0), r(1, 0)) > 1e-9;
  const double roll = is_upright ? std::atan2(r(2, 1), r(2, 2)) : 0;
  const double yaw = is_upright ? std::atan2(r(1, 0), r(0, 0)) : std::atan2(-r(0, 1), r(1, 1));
  return fmt::format("<origin xyz=\"{}\" rpy=\"{}\"/>", numbers(pose.translation()),
                     numbers({roll, pitch, yaw}));
}

class Writer {
 public:
  Writer(Robot& robot, const std::string& folder) : robot_(robot), folder_(folder) {}

  std::string write() {
    out_ = fmt::format("<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n", markup_text(robot_.name));
    for (std::size_t i = 0; i < robot_.bodies.size(); ++i) add(i);
    out_ += "</robot>\n";
    if (has_ellipsoids_) lose("URDF has no ellipsoids: each is a box of its volume");
    for (const std::string& file : unread_) lose("mesh " + file + ": URDF knows STL, OBJ and DAE");
    return std::move(out_);
  }

 private:
  void lose(const std::string& what) { robot_.left_out.push_back(what); }
  void line(int depth, const std::string& text) {
    out_ += std::string(static_cast<std::size_t>(2 * depth), ' ') + text + '\n';
  }

  /// URDF's links begin at their joint.
  static Transform link_in(const Body& body) {
    return Transform(
        Eigen::Translation3d(body.joints.empty() ? Vec3::Zero() : body.joints.back().at_m));
  }

  void add(std::size_t index) {
    const Body& body = robot_.bodies[index];
    auto inertial = body.inertial;
    if (body.parent >= 0) carry(body, inertial);
    const Transform back = link_in(body).inverse();
    line(1, fmt::format("<link name=\"{}\">", markup_text(body.name)));
    if (inertial) add_inertial(*inertial, back * inertial->pose);
    for (const Geom& geom : body.geoms) add_geom(geom, back * geom.pose);
    line(1, "</link>");
    if (body.has_imu) {
      line(1,
           fmt::format("<gazebo reference=\"{}\"><sensor name=\"{}_imu\" type=\"imu\"/></gazebo>",
                       markup_text(body.name), markup_text(body.name)));
    }
  }

  /// The joints above a body; several get links of their own between them.
  void carry(const Body& body, std::optional<Inertial>& inertial) {
    const Body& parent = robot_.bodies[static_cast<std::size_t>(body.parent)];
    std::string above = parent.name;
    Transform from = link_in(parent).inverse() * body.pose;
    if (body.joints.empty())
      return add_joint({.name = body.name + "_fixed"}, "fixed", above, body.name, from);
    std::optional<Inertial> share;
    if (inertial && body.joints.size() > 1) share = share_of(body, *inertial);
    for (std::size_t i = 0; i < body.joints.size(); ++i) {
      const Joint& joint = body.joints[i];
      const bool is_last = i + 1 == body.joints.size();
      const std::string below =
          is_last ? body.name : fmt::format("{}_at_{}", body.name, joint.name);
      const Transform at = from * Eigen::Translation3d(joint.at_m);
      add_joint(joint, type_of(joint), above, below, at * start_of(joint));
      if (is_last) break;
      add_link_between(below, share);
      above = below;
      from = Transform(Eigen::Translation3d(-joint.at_m));
    }
    if (body.joints.size() > 1) {
      lose(
          fmt::format("body {} turns by {} joints: {} links between them take {:.0f} % of its mass "
                      "each",
                      body.name, body.joints.size(), body.joints.size() - 1, 100 * kShare));
    }
  }

  /// From the pose of the file to the joint's zero.
  static Transform start_of(const Joint& joint) {
    if (joint.slides) return Transform(Eigen::Translation3d(-joint.start * joint.axis));
    return Transform(Eigen::AngleAxisd(-joint.start, joint.axis));
  }

  static const char* type_of(const Joint& joint) {
    return joint.slides ? "prismatic" : joint.has_stops ? "revolute" : "continuous";
  }

  /// What each link between the joints gets, taken from the body.
  static Inertial share_of(const Body& body, Inertial& whole) {
    const double left = 1 - kShare * static_cast<double>(body.joints.size() - 1);
    Inertial share;
    share.mass_kg = whole.mass_kg * kShare;
    share.inertia_kg_m2 = Mat3::Identity() * whole.inertia_kg_m2.trace() / 3 * kShare;
    whole.mass_kg *= left;
    whole.inertia_kg_m2 *= left;
    return share;
  }

  void add_link_between(const std::string& name, const std::optional<Inertial>& share) {
    line(1, fmt::format("<link name=\"{}\">", markup_text(name)));
    if (share) add_inertial(*share, Transform::Identity());
    line(1, "</link>");
  }

  void add_joint(const Joint& joint, const char* type, const std::string& above,
                 const std::string& below, const Transform& at) {
    line(1, fmt::format("<joint name=\"{}\" type=\"{}\">", markup_text(joint.name), type));
    line(2, origin(at));
    line(2, fmt::format("<parent link=\"{}\"/>", markup_text(above)));
    line(2, fmt::format("<child link=\"{}\"/>", markup_text(below)));
    if (std::string(type) != "fixed") add_motion(joint);
    line(1, "</joint>");
  }

  void add_motion(const Joint& joint) {
    line(2, fmt::format("<axis xyz=\"{}\"/>", numbers(joint.axis)));
    std::string limit;
    if (joint.has_stops)
      limit = fmt::format(" lower=\"{:.12g}\" upper=\"{:.12g}\"", joint.lower, joint.upper);
    if (joint.motor.torque_n_m > 0)
      limit += fmt::format(" effort=\"{:.12g}\"", joint.motor.torque_n_m);
    if (joint.motor.no_load_rad_s > 0)
      limit += fmt::format(" velocity=\"{:.12g}\"", joint.motor.no_load_rad_s);
    if (!limit.empty()) line(2, "<limit" + limit + "/>");
    const Motor& motor = joint.motor;
    const bool is_passive = motor.damping_n_m_s > 0 || motor.friction_n_m > 0;
    if (is_passive && !motor.has_actuator) {
      line(2, fmt::format("<dynamics damping=\"{:.12g}\" friction=\"{:.12g}\"/>",
                          motor.damping_n_m_s, motor.friction_n_m));
    }
    for (const Follower& each : robot_.followers) {
      if (each.first == joint.name) {
        line(2, fmt::format("<mimic joint=\"{}\" multiplier=\"{:.12g}\" offset=\"{:.12g}\"/>",
                            markup_text(each.second), each.factor, each.offset));
      }
    }
  }

  void add_inertial(const Inertial& own, const Transform& pose) {
    const Mat3& i = own.inertia_kg_m2;
    line(2, "<inertial>");
    line(3, origin(pose));
    line(3, fmt::format("<mass value=\"{:.12g}\"/>", own.mass_kg));
    line(3, fmt::format("<inertia ixx=\"{:.12g}\" ixy=\"{:.12g}\" ixz=\"{:.12g}\" iyy=\"{:.12g}\" "
                        "iyz=\"{:.12g}\" izz=\"{:.12g}\"/>",
                        i(0, 0), i(0, 1), i(0, 2), i(1, 1), i(1, 2), i(2, 2)));
    line(2, "</inertial>");
  }

  void add_geom(const Geom& geom, const Transform& pose) {
    if (geom.is_seen) add_shape("visual", geom, pose);
    if (geom.touches) add_shape("collision", geom, pose);
  }

  void add_shape(const char* what, const Geom& geom, const Transform& pose) {
    for (const auto& [shape, at] : shapes_of(geom)) {
      line(2, fmt::format("<{}>", what));
      line(3, origin(pose * at));
      line(3, "<geometry>" + shape + "</geometry>");
      if (std::string(what) == "visual" && !geom.rgba.empty()) {
        line(3, fmt::format("<material name=\"rgba_{0:.3g}_{1:.3g}_{2:.3g}_{3:.3g}\"><color "
                            "rgba=\"{0:.3g} {1:.3g} {2:.3g} {3:.3g}\"/></material>",
                            geom.rgba[0], geom.rgba[1], geom.rgba[2], geom.rgba[3]));
      }
      line(2, fmt::format("</{}>", what));
    }
  }

  /// URDF has no capsules.
  std::vector<std::pair<std::string, Transform>> shapes_of(const Geom& geom) {
    const Vec3& s = geom.size;
    const auto cylinder =
        fmt::format("<cylinder radius=\"{:.12g}\" length=\"{:.12g}\"/>", s.x(), 2 * s.y());
    const auto sphere = fmt::format("<sphere radius=\"{:.12g}\"/>", s.x());
    const auto up = [](double z) { return Transform(Eigen::Translation3d(0, 0, z)); };
    switch (geom.kind) {
      case Geom::Kind::kBox:
        return {{fmt::format("<box size=\"{}\"/>", numbers(2 * s)), up(0)}};
      case Geom::Kind::kSphere:
        return {{sphere, up(0)}};
      case Geom::Kind::kCylinder:
        return {{cylinder, up(0)}};
      case Geom::Kind::kCapsule:
        return {{cylinder, up(0)}, {sphere, up(s.y())}, {sphere, up(-s.y())}};
      case Geom::Kind::kEllipsoid:
        has_ellipsoids_ = true;
        return {{fmt::format("<box size=\"{}\"/>", numbers(2 * kBoxOfEllipsoid * s)), up(0)}};
      case Geom::Kind::kMesh:
        break;
    }
    return mesh_of(geom);
  }

  std::vector<std::pair<std::string, Transform>> mesh_of(const Geom& geom) {
    const Mesh& mesh = robot_.meshes.at(geom.mesh);
    const std::string ending = ending_of(mesh.file);
    if (ending != ".stl" && ending != ".obj" && ending != ".dae") {
      unread_.insert(mesh.file);
      return {};
    }
    const std::string file = path_from(folder_, mesh.file);
    return {{fmt::format("<mesh filename=\"{}\" scale=\"{}\"/>", markup_text(file),
                         numbers(mesh.scale)),
             Transform::Identity()}};
  }

  Robot& robot_;
  const std::string folder_;
  std::string out_;
  bool has_ellipsoids_ = false;
  std::set<std::string> unread_;
};

}  // namespace

std::string urdf_of(Robot& robot, const std::string& folder) {
  return Writer(robot, folder).write();
}

}  // namespace verp::mjcf
