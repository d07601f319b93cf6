#include <fmt/format.h>

#include <cmath>
#include <map>

#include "host/author/mjcf/mjcf.hpp"
#include "host/robot/model/params.hpp"

namespace verp::mjcf {
namespace {

Geom shape_of(const model::Collision& from) {
  using Shape = model::Collision::Shape;
  static const std::map<Shape, Geom::Kind> kKinds = {{Shape::kBox, Geom::Kind::kBox},
                                                     {Shape::kSphere, Geom::Kind::kSphere},
                                                     {Shape::kCylinder, Geom::Kind::kCylinder},
                                                     {Shape::kCapsule, Geom::Kind::kCapsule}};
  Geom geom;
  geom.kind = kKinds.at(from.shape);
  geom.pose = from.pose;
  geom.size = from.shape == Shape::kBox ? Vec3(from.size_m / 2)
                                        : Vec3(from.size_m.x(), from.size_m.z() / 2, 0);
  geom.mass_kg = 0;
  geom.touches = true;
  geom.friction = from.friction;
  return geom;
}

class Converter {
 public:
  explicit Converter(const model::Entity& entity) : e_(entity), params_(model::make_params(e_)) {}

  Robot convert() {
    out_.name = e_.name;
    place_[0] = 0;
    add_body(0, -1);
    for (const std::size_t joint : model::outward(e_)) {
      place_[joint + 1] = static_cast<int>(out_.bodies.size());
      add_body(joint + 1, place_.at(static_cast<std::size_t>(e_.joints[joint].parent)));
      add_joint(joint);
    }
    add_frames();
    for (const model::NoCollide& pair : e_.no_collide)
      out_.apart.emplace_back(name_of(pair.link), name_of(pair.other));
    tell();
    return std::move(out_);
  }

 private:
  std::string name_of(int node) const { return e_.nodes[static_cast<std::size_t>(node)].name; }

  void add_body(std::size_t index, int parent) {
    const model::Node& node = e_.nodes[index];
    Body body;
    body.name = node.name;
    body.parent = parent;
    Inertial own;
    own.mass_kg = node.mass_kg;
    own.pose.translation() = node.com_m;
    own.inertia_kg_m2 = node.inertia_kg_m2;
    body.inertial = own;
    for (const model::Collision& each : node.collisions) body.geoms.push_back(shape_of(each));
    for (const model::Visual& each : node.visuals) add_visual(each, body);
    out_.bodies.push_back(body);
  }

  void add_visual(const model::Visual& from, Body& body) {
    Geom geom;
    if (from.shape != model::Visual::Shape::kMesh) {
      model::Collision same;
      same.shape = static_cast<model::Collision::Shape>(from.shape);
      same.pose = from.pose;
      same.size_m = from.size_m;
      geom = shape_of(same);
    } else if (from.mesh.empty()) {
      out_.left_out.push_back("the mesh " + from.mesh_uri + " is not there");
      return;
    } else {
      geom.kind = Geom::Kind::kMesh;
      geom.pose = from.pose;
      geom.mass_kg = 0;
      geom.mesh = fmt::format("mesh_{}", out_.meshes.size());
      out_.meshes[geom.mesh] = {from.mesh, from.size_m};
    }
    geom.touches = false;
    geom.is_seen = true;
    if (from.rgba) geom.rgba = {from.rgba->begin(), from.rgba->end()};
    body.geoms.push_back(geom);
  }

  void add_joint(std::size_t index) {
    const model::Joint& from = e_.joints[index];
    const model::Servo& servo = from.servo;
    Body& body = out_.bodies.back();
    body.pose.translation() = from.origin_m;
    Joint joint;
    joint.name = from.name;
    joint.axis = from.axis;
    joint.has_stops = true;
    joint.lower = from.lower_rad;
    joint.upper = from.upper_rad;
    joint.motor.damping_n_m_s = from.damping_n_m_s;
    joint.motor.friction_n_m = from.friction_n_m;
    out_.stand[joint.name] = from.stand_rad;
    if (from.follows >= 0) {
      out_.followers.push_back({from.name, e_.joints[static_cast<std::size_t>(from.follows)].name,
                                from.offset_rad, from.ratio});
    } else {
      joint.motor.has_actuator = true;
      joint.motor.torque_n_m = servo.most_torque_n_m();
      joint.motor.no_load_rad_s = servo.no_load_speed_rad_s;
      joint.motor.kp_n_m_rad = 1 / static_cast<double>(params_.joint[index].compliance_rad_nm);
      joint.motor.armature_kg_m2 = servo.gearbox.armature_kg_m2;
      joint.motor.damping_n_m_s += servo.gearbox.f_visc_n_m_s;
      joint.motor.friction_n_m += servo.gearbox.f_base_n_m;
    }
    body.joints.push_back(joint);
  }

  void add_frames() {
    for (const model::Limb& limb : e_.limbs) {
      if (limb.name.find("leg") == std::string::npos || limb.joints.empty()) continue;
      const std::size_t foot = static_cast<std::size_t>(limb.joints.back()) + 1;
      body_of(foot).sites.push_back(
          {limb.name == "left_leg" ? "left_sole" : "right_sole", limb.tip});
    }
    if (!e_.imu) return;
    Body& body = body_of(static_cast<std::size_t>(e_.imu->node));
    body.has_imu = true;
    body.sites.push_back({"imu", e_.imu->pose});
  }

  Body& body_of(std::size_t node) { return out_.bodies[static_cast<std::size_t>(place_.at(node))]; }

  void tell() {
    const auto lose = [&](bool any, const char* what) {
      if (any) out_.left_out.emplace_back(what);
    };
    lose(true, "servos: ids, directions, delays, encoders, heat, friction that grows with load");
    lose(true, "gait, balance and safety parameters");
    lose(!e_.cameras.empty() || !e_.lasers.empty() || !e_.force_torques.empty() ||
             e_.feet.id[0] != 0,
         "cameras, lasers, force sensors");
  }

  const model::Entity& e_;
  const Params params_;
  Robot out_;
  std::map<std::size_t, int> place_;  ///< of a node in the bodies
};

}  // namespace

Robot robot_of(const model::Entity& entity) {
  return Converter(entity).convert();
}

}  // namespace verp::mjcf
