#include "host/trace/record/urdf.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

namespace verp::record {
namespace {

constexpr double kStick_m = 0.01;

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool plain = c != '<' && c != '>' && c != '&' && c != '"' && c >= ' ';
    out += plain ? std::string(1, c) : fmt::format("&#{};", static_cast<unsigned char>(c));
  }
  return out;
}

std::string name_of(const Params& params, int node) {
  if (node == 0) return "body";
  const char* name = params.joint[node - 1].name;
  return escaped({name, ::strnlen(name, kNameLength)});
}

std::string xyz(const Xyz& v) {
  return fmt::format("{:g} {:g} {:g}", v.x, v.y, v.z);
}

/// A box from the link's origin to a joint on it.
std::string stick(const Xyz& to) {
  const double x = static_cast<double>(to.x), y = static_cast<double>(to.y),
               z = static_cast<double>(to.z), length_m = std::sqrt(x * x + y * y + z * z);
  if (length_m < kStick_m) return "";
  return fmt::format(
      "<visual><origin xyz=\"{:g} {:g} {:g}\" rpy=\"0 {:g} {:g}\"/><geometry>"
      "<box size=\"{:g} {:g} {:g}\"/></geometry></visual>",
      x / 2, y / 2, z / 2, std::atan2(-z, std::hypot(x, y)), std::atan2(y, x), length_m, kStick_m,
      kStick_m);
}

std::string link(const Params& params, int node) {
  const float mass_kg = node == 0 ? params.body_mass_kg : params.joint[node - 1].mass_kg;
  const Xyz& com_m = node == 0 ? params.body_com_m : params.joint[node - 1].com_link_m;
  std::string out = fmt::format(
      "<link name=\"{}\"><inertial><origin xyz=\"{}\"/><mass value=\"{:g}\"/><inertia ixx=\"1e-5\" "
      "ixy=\"0\" ixz=\"0\" iyy=\"1e-5\" iyz=\"0\" izz=\"1e-5\"/></inertial>"
      "<visual><geometry><sphere radius=\"{:g}\"/></geometry></visual>",
      name_of(params, node), xyz(com_m), mass_kg, kStick_m);
  for (int j = 0; j < params.joint_count; ++j) {
    if (params.joint[j].parent == node) out += stick(params.joint[j].origin_parent_m);
  }
  for (const LegParams& leg : params.leg) {
    if (leg.solver != LegSolver::kNone && leg.joint[kLegJoints - 1] == node - 1)
      out += stick(leg.sole_foot_m);
  }
  return out + "</link>\n";
}

std::string joint(const Params& params, int j) {
  const JointParams& p = params.joint[j];
  return fmt::format(
      "<joint name=\"{}\" type=\"revolute\"><parent link=\"{}\"/><child link=\"{}\"/><origin "
      "xyz=\"{}\"/><axis xyz=\"{}\"/><limit lower=\"{:g}\" upper=\"{:g}\" velocity=\"{:g}\" "
      "effort=\"0\"/></joint>\n",
      name_of(params, j + 1), name_of(params, p.parent), name_of(params, j + 1),
      xyz(p.origin_parent_m), xyz(p.axis), p.lower_rad, p.upper_rad, p.velocity_limit_rad_s);
}

}  // namespace

std::string urdf(const Params& params) {
  std::string out = fmt::format("<robot name=\"{}\">\n",
                                escaped({params.name, ::strnlen(params.name, kNameLength)}));
  for (int node = 0; node <= params.joint_count; ++node) out += link(params, node);
  for (int j = 0; j < params.joint_count; ++j) out += joint(params, j);
  return out + "</robot>\n";
}

}  // namespace verp::record
