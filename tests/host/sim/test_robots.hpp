#pragma once
#include <cmath>
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::sim::test {

inline constexpr double kGravity_m_s2 = 9.80665;  // as in the twin

/// An XM430-W210 at 12 V without play and friction.
inline model::Servo plain_servo() {
  model::Servo servo;
  servo.type = "test";
  servo.stall_torque_n_m = 3.0;
  servo.no_load_speed_rad_s = 8.0;
  servo.stall_current_a = 2.3;
  return servo;
}

inline model::Node box(const char* name, double mass_kg, const model::Vec3& size_m,
                       const model::Vec3& com_m) {
  model::Node node;
  node.name = name;
  node.mass_kg = mass_kg;
  node.com_m = com_m;
  const model::Vec3 s2 = size_m.cwiseProduct(size_m);
  node.inertia_kg_m2 =
      (mass_kg / 12 * model::Vec3(s2.y() + s2.z(), s2.x() + s2.z(), s2.x() + s2.y())).asDiagonal();
  return node;
}

inline void add_collision(model::Node& node, const model::Vec3& size_m) {
  model::Collision shape;
  shape.size_m = size_m;
  shape.pose.translation() = node.com_m;
  node.collisions.push_back(shape);
}

inline model::Joint joint(const char* name, int parent, const model::Vec3& origin_m,
                          const model::Vec3& axis) {
  model::Joint out;
  out.name = name;
  out.parent = parent;
  out.origin_m = origin_m;
  out.axis = axis;
  out.lower_rad = -3;
  out.upper_rad = 3;
  out.servo = plain_servo();
  return out;
}

inline constexpr double kArmMass = 0.5;
inline constexpr double kArmLength = 0.1;  ///< to the centre of mass
inline constexpr double kArmInertia = 1e-4;

/// Hangs along -z at zero and turns about y.
inline model::Entity arm() {
  model::Entity entity;
  entity.nodes.push_back(box("base", 10, {0.2, 0.2, 0.2}, {0, 0, 0}));
  entity.nodes.push_back(box("arm", kArmMass, {0.01, 0.01, 0.01}, {0, 0, -kArmLength}));
  entity.nodes[1].inertia_kg_m2 = model::Mat3::Identity() * kArmInertia;
  entity.joints.push_back(joint("shoulder", 0, {0, 0, 0}, {0, 1, 0}));
  return entity;
}

/// Yaw, roll, pitch, knee, ankle pitch, ankle roll. IMU in the body, force sensors under the feet.
inline model::Entity biped() {
  model::Entity entity;
  entity.nodes.push_back(box("body", 1.6, {0.08, 0.12, 0.15}, {0.005, 0, 0.02}));
  add_collision(entity.nodes[0], {0.08, 0.12, 0.15});
  for (int side = 0; side < 2; ++side) {
    const double y = side == 0 ? 0.037 : -0.037;
    const int first = static_cast<int>(entity.joints.size());
    model::Limb leg;
    leg.name = side == 0 ? "left_leg" : "right_leg";
    const auto add = [&](const char* name, const model::Vec3& origin_m, const model::Vec3& axis,
                         const model::Node& node) {
      const int index = static_cast<int>(entity.joints.size());
      entity.joints.push_back(joint(name, index == first ? 0 : index, origin_m, axis));
      entity.nodes.push_back(node);
      leg.joints.push_back(index);
    };
    add("hip_yaw", {0, y, -0.1}, {0, 0, 1}, box("hip_yaw", 0.03, {0.03, 0.03, 0.03}, {0, 0, 0}));
    add("hip_roll", {0, 0, 0}, {1, 0, 0}, box("hip_roll", 0.16, {0.04, 0.036, 0.04}, {0, 0, 0}));
    add("hip_pitch", {0, 0, 0}, {0, 1, 0}, box("thigh", 0.12, {0.04, 0.04, 0.07}, {0, 0, -0.05}));
    add("knee", {0, 0, -0.093}, {0, 1, 0}, box("shank", 0.08, {0.04, 0.04, 0.07}, {0, 0, -0.045}));
    add("ankle_pitch", {0, 0, -0.093}, {0, 1, 0},
        box("ankle", 0.16, {0.04, 0.036, 0.04}, {0, 0, 0}));
    model::Node foot = box("foot", 0.08, {0.104, 0.066, 0.01}, {0, 0, -0.0285});
    add_collision(foot, {0.104, 0.066, 0.01});
    add("ankle_roll", {0, 0, 0}, {1, 0, 0}, foot);
    leg.tip.translation() = model::Vec3(0, 0, -0.0335);
    leg.sole_min_m = model::Vec3(-0.052, -0.033, 0);
    leg.sole_max_m = model::Vec3(0.052, 0.033, 0);
    entity.limbs.push_back(leg);
  }
  model::ImuSensor imu;
  imu.pose.translation() = model::Vec3(0.01, 0.02, 0.03);
  imu.gyro_rad_s_per_count = 1e-3;
  imu.accel_m_s2_per_count = 1e-3;
  imu.gyro_noise_rad_s_rthz = 0.0003;
  imu.gyro_bias_rad_s = 0.005;
  imu.accel_noise_m_s2_rthz = 0.003;
  imu.accel_bias_m_s2 = 0.05;
  entity.imu = imu;
  entity.feet.id = {111, 112};
  entity.feet.newton_per_count = 0.01;
  return entity;
}

/// Hips hip_height_m over the ankles, soles level.
inline std::vector<double> crouch(const model::Entity& entity, double hip_height_m,
                                  double thigh_m = 0.093) {
  std::vector<double> angle(entity.joints.size(), 0.0);
  const double bend = std::acos(hip_height_m / (2 * thigh_m));
  for (const model::Limb& limb : entity.limbs) {
    if (limb.name != "left_leg" && limb.name != "right_leg") continue;
    angle[static_cast<std::size_t>(limb.joints[2])] = -bend;
    angle[static_cast<std::size_t>(limb.joints[3])] = 2 * bend;
    angle[static_cast<std::size_t>(limb.joints[4])] = -bend;
  }
  return angle;
}

}  // namespace verp::sim::test
