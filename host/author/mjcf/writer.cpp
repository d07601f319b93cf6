#include <fmt/format.h>

#include <algorithm>

#include "host/author/mjcf/words.hpp"
#include "host/os/files/markup_text.hpp"

namespace verp::mjcf {
namespace {

using files::markup_text;

std::string pose_of(const Transform& pose) {
  const Eigen::Quaterniond q(pose.linear());
  std::string out = fmt::format(" pos=\"{}\"", numbers(pose.translation()));
  if (q.vec().norm() > 1e-12)
    out += fmt::format(" quat=\"{:.12g} {:.12g} {:.12g} {:.12g}\"", q.w(), q.x(), q.y(), q.z());
  return out;
}

class MjcfWriter {
 public:
  MjcfWriter(Robot& robot, const std::string& folder) : r_(robot), folder_(folder) {}

  std::string write() {
    line(0, fmt::format("<mujoco model=\"{}\">", markup_text(r_.name)));
    line(1, "<compiler angle=\"radian\" autolimits=\"true\"/>");
    assets();
    line(1, "<worldbody>");
    line(2, "<light pos=\"0 0 3\"/>");
    line(2, "<geom name=\"floor\" type=\"plane\" size=\"0 0 0.1\"/>");
    body(0, 2);
    line(1, "</worldbody>");
    contacts();
    couplings();
    actuators();
    own_numbers();
    line(1, "<sensor>");
    for (const char* const kind : {"gyro", "accelerometer"}) {
      if (has_site("imu")) line(2, fmt::format("<{0} name=\"imu_{0}\" site=\"imu\"/>", kind));
    }
    line(1, "</sensor>");
    keyframe();
    line(0, "</mujoco>");
    return std::move(out_);
  }

 private:
  void line(int depth, const std::string& text) {
    out_ += std::string(static_cast<std::size_t>(2 * depth), ' ') + text + '\n';
  }

  bool has_site(const std::string& name) const {
    for (const Body& body : r_.bodies) {
      for (const Site& site : body.sites) {
        if (site.name == name) return true;
      }
    }
    return false;
  }

  /// MuJoCo has no DAE.
  static bool can_read(const Mesh& mesh) {
    const std::string ending = ending_of(mesh.file);
    return ending == ".stl" || ending == ".obj";
  }

  void assets() {
    if (r_.meshes.empty()) return;
    line(1, "<asset>");
    for (const auto& [name, mesh] : r_.meshes) {
      const std::string file = path_from(folder_, mesh.file);
      if (!can_read(mesh)) {
        r_.left_out.push_back("mesh " + file + ": MuJoCo reads STL and OBJ");
        continue;
      }
      line(2, fmt::format("<mesh name=\"{}\" file=\"{}\" scale=\"{}\"/>", name, markup_text(file),
                          numbers(mesh.scale)));
    }
    line(1, "</asset>");
  }

  void body(std::size_t index, int depth) {
    const Body& b = r_.bodies[index];
    Transform pose = b.pose;
    if (index == 0) pose.translation().z() = standing_height();
    line(depth, fmt::format("<body name=\"{}\"{}>", markup_text(b.name), pose_of(pose)));
    if (index == 0) line(depth + 1, "<freejoint/>");
    if (b.inertial) inertial(*b.inertial, depth + 1);
    for (const Joint& each : b.joints) joint(each, depth + 1);
    for (const Geom& each : b.geoms) geom(each, depth + 1);
    for (const Site& each : b.sites)
      line(depth + 1, fmt::format("<site name=\"{}\"{}/>", each.name, pose_of(each.pose)));
    for (std::size_t i = index + 1; i < r_.bodies.size(); ++i) {
      if (r_.bodies[i].parent == static_cast<int>(index)) body(i, depth + 1);
    }
    line(depth, "</body>");
  }

  void inertial(const Inertial& own, int depth) {
    const Mat3 i = own.pose.linear() * own.inertia_kg_m2 * own.pose.linear().transpose();
    line(depth, fmt::format("<inertial pos=\"{}\" mass=\"{:.12g}\" fullinertia=\"{:.12g} {:.12g} "
                            "{:.12g} {:.12g} {:.12g} {:.12g}\"/>",
                            numbers(own.pose.translation()), own.mass_kg, i(0, 0), i(1, 1), i(2, 2),
                            i(0, 1), i(0, 2), i(1, 2)));
  }

  void joint(const Joint& each, int depth) {
    std::string text =
        fmt::format("<joint name=\"{}\" type=\"{}\" pos=\"{}\" axis=\"{}\"", markup_text(each.name),
                    each.slides ? "slide" : "hinge", numbers(each.at_m), numbers(each.axis));
    if (each.has_stops) text += fmt::format(" range=\"{:.12g} {:.12g}\"", each.lower, each.upper);
    joints_.push_back(each.name);
    line(depth,
         text + fmt::format(" armature=\"{:.6g}\" damping=\"{:.6g}\" frictionloss=\"{:.6g}\"/>",
                            each.motor.armature_kg_m2, each.motor.damping_n_m_s,
                            each.motor.friction_n_m));
  }

  void geom(const Geom& each, int depth) {
    static const std::map<Geom::Kind, std::pair<const char*, int>> kWords = {
        {Geom::Kind::kBox, {"box", 3}},
        {Geom::Kind::kSphere, {"sphere", 1}},
        {Geom::Kind::kCylinder, {"cylinder", 2}},
        {Geom::Kind::kCapsule, {"capsule", 2}},
        {Geom::Kind::kEllipsoid, {"ellipsoid", 3}}};
    std::string text = fmt::format("<geom{}", pose_of(each.pose));
    if (each.kind == Geom::Kind::kMesh) {
      if (!can_read(r_.meshes.at(each.mesh))) return;
      text += fmt::format(" type=\"mesh\" mesh=\"{}\"", each.mesh);
    } else {
      const auto& [word, count] = kWords.at(each.kind);
      text += fmt::format(" type=\"{}\" size=\"", word);
      for (int i = 0; i < count; ++i)
        text += fmt::format("{}{:.12g}", i > 0 ? " " : "", each.size[i]);
      text += "\"";
    }
    if (each.touches)
      text += fmt::format(" friction=\"{:.6g} 0.005 0.0001\" group=\"3\"", each.friction);
    if (!each.touches) text += " contype=\"0\" conaffinity=\"0\" group=\"2\"";
    if (each.rgba.size() == 4) {
      text += fmt::format(" rgba=\"{:.3g} {:.3g} {:.3g} {:.3g}\"", each.rgba[0], each.rgba[1],
                          each.rgba[2], each.rgba[3]);
    }
    line(depth, text + " mass=\"0\"/>");
  }

  void contacts() {
    line(1, "<contact>");
    for (const auto& [one, other] : r_.apart) {
      line(2, fmt::format("<exclude body1=\"{}\" body2=\"{}\"/>", markup_text(one),
                          markup_text(other)));
    }
    line(1, "</contact>");
  }

  void couplings() {
    line(1, "<equality>");
    for (const Follower& each : r_.followers) {
      line(2, fmt::format("<joint joint1=\"{}\" joint2=\"{}\" polycoef=\"{:.12g} {:.12g} 0 0 0\"/>",
                          markup_text(each.first), markup_text(each.second), each.offset,
                          each.factor));
    }
    line(1, "</equality>");
  }

  /// A position loop with the motor's back-EMF: as MuJoCo of any version reads it.
  void actuators() {
    line(1, "<actuator>");
    for (const Body& body : r_.bodies) {
      for (const Joint& each : body.joints) {
        const Motor& motor = each.motor;
        if (!motor.has_actuator) continue;
        const double back_emf =
            motor.no_load_rad_s > 0 ? motor.torque_n_m / motor.no_load_rad_s : 0;
        line(2, fmt::format("<general name=\"{0}\" joint=\"{0}\" biastype=\"affine\" "
                            "gainprm=\"{1:.6g}\" biasprm=\"0 {2:.6g} {3:.6g}\" "
                            "ctrlrange=\"{4:.12g} {5:.12g}\" forcerange=\"{6:.6g} {7:.6g}\"/>",
                            markup_text(each.name), motor.kp_n_m_rad, -motor.kp_n_m_rad, -back_emf,
                            each.lower, each.upper, -motor.torque_n_m, motor.torque_n_m));
      }
    }
    line(1, "</actuator>");
  }

  void own_numbers() {
    line(1, "<custom>");
    for (const Body& body : r_.bodies) {
      for (const Joint& each : body.joints) {
        if (each.motor.no_load_rad_s <= 0) continue;
        line(2, fmt::format("<numeric name=\"{}{}\" data=\"{:.9g}\"/>", kNoLoad,
                            markup_text(each.name), each.motor.no_load_rad_s));
      }
    }
    line(1, "</custom>");
  }

  Transform standing(std::size_t index) const {
    const Body& b = r_.bodies[index];
    Transform pose = b.parent < 0 ? Transform::Identity()
                                  : standing(static_cast<std::size_t>(b.parent)) * b.pose;
    for (const Joint& each : b.joints) {
      const auto angle = r_.stand.find(each.name);
      if (angle != r_.stand.end()) pose.rotate(Eigen::AngleAxisd(angle->second, each.axis));
    }
    return pose;
  }

  double standing_height() const {
    double lowest = 0;
    for (std::size_t i = 0; i < r_.bodies.size(); ++i) {
      for (const Site& site : r_.bodies[i].sites)
        lowest = std::min(lowest, (standing(i) * site.pose).translation().z());
    }
    return -lowest;
  }

  void keyframe() {
    std::string qpos = fmt::format("0 0 {:.9g} 1 0 0 0", standing_height());
    for (const std::string& joint : joints_) {
      const auto angle = r_.stand.find(joint);
      qpos += fmt::format(" {:.9g}", angle == r_.stand.end() ? 0.0 : angle->second);
    }
    line(1, fmt::format("<keyframe><key name=\"stand\" qpos=\"{}\"/></keyframe>", qpos));
  }

  Robot& r_;
  const std::string folder_;
  std::string out_;
  std::vector<std::string> joints_;  ///< in the order of the text, as in qpos
};

}  // namespace

std::string mjcf_of(Robot& robot, const std::string& folder) {
  return MjcfWriter(robot, folder).write();
}

}  // namespace verp::mjcf
