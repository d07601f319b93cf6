#include "host/author/import/source.hpp"

#include <tinyxml2.h>

#include <string_view>

#include "host/author/mjcf/mjcf.hpp"

namespace verp::import {
namespace {

/// Of the outer element; empty: no XML, which the reader of URDF tells better.
std::string outer_element(const std::string& file) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) return "";
  return document.RootElement() == nullptr ? "" : document.RootElement()->Name();
}

Drive drive_of(const mjcf::Motor& motor) {
  return {.stall_torque_n_m = motor.torque_n_m,
          .no_load_rad_s = motor.no_load_rad_s,
          .armature_kg_m2 = motor.armature_kg_m2,
          .friction_n_m = motor.friction_n_m,
          .damping_n_m_s = motor.damping_n_m_s,
          .kp_n_m_rad = motor.kp_n_m_rad};
}

}  // namespace

Source read_source(const std::string& file, const std::string& folder) {
  Source out;
  if (outer_element(file) != "mujoco") return out;
  mjcf::Robot robot = mjcf::read_robot(file);
  out.format = "MJCF";
  out.urdf = mjcf::urdf_of(robot, folder);
  out.left_out = robot.left_out;
  out.stand = robot.stand;
  for (const mjcf::Body& body : robot.bodies) {
    for (const mjcf::Joint& joint : body.joints) {
      if (joint.motor.torque_n_m > 0) out.drives[joint.name] = drive_of(joint.motor);
    }
  }
  return out;
}

}  // namespace verp::import
