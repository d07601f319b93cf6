#include "host/author/import/source.hpp"

#include <tinyxml2.h>

#include "host/author/mjcf/mjcf.hpp"
#include "host/author/plain_sdf/plain_sdf.hpp"
#include "host/author/xacro/xacro.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/encoding.hpp"

namespace verp::import {
namespace {

/// The outer element's name. Empty where the text is no XML: the reader of URDF then says why.
std::string outer_element(const std::string& text) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) return "";
  return document.RootElement() == nullptr ? "" : document.RootElement()->Name();
}

Drive drive_of(const mjcf::Motor& motor) {
  return {.stall_torque_n_m = motor.torque_n_m,
          .no_load_rad_s = motor.no_load_rad_s,
          .is_line = motor.no_load_rad_s > 0,
          .armature_kg_m2 = motor.armature_kg_m2,
          .friction_n_m = motor.friction_n_m,
          .damping_n_m_s = motor.damping_n_m_s,
          .kp_n_m_rad = motor.kp_n_m_rad};
}

Source source_of_xacro(const std::string& file, const std::string& folder) {
  const xacro::Expanded expanded = xacro::expand(file, folder);
  Source out;
  out.format = "xacro";
  out.urdf = expanded.urdf;
  out.left_out = expanded.left_out;
  return out;
}

Source source_of(mjcf::Robot robot, const char* format, const std::string& folder) {
  Source out;
  out.format = format;
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

}  // namespace

Source read_source(const std::string& file, const std::string& folder) {
  const std::string text = model::utf8_of(file, files::read(file).value_or(""));
  const std::string outer = outer_element(text);
  if (outer == "mujoco") return source_of(mjcf::read_robot(file), "mjcf", folder);
  if (outer == "sdf") return source_of(plain_sdf::read_robot(file), "sdf", folder);
  // A URDF that xacro made may still name its namespace.
  const bool is_xacro = text.find("<xacro:") != text.npos;
  return is_xacro ? source_of_xacro(file, folder) : Source{};
}

}  // namespace verp::import
