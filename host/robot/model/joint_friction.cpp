#include "host/robot/model/joint_friction.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace verp::model {
namespace {

bool has_own(const Joint& joint) {
  return joint.friction_n_m > 0 || joint.damping_n_m_s > 0;
}

/// Rotor and Stribeck's curve stay: without friction they have no part in it.
void drop(Gearbox& gears) {
  gears.f_base_n_m = gears.f_strib_n_m = gears.f_visc_n_m_s = gears.l_base = gears.l_strib = 0;
  gears.l_external = gears.l_external_strib = 0;
  gears.q_motor_per_n_m = gears.q_external_per_n_m = 0;
}

std::string what_the_file_has(const Entity& entity) {
  double friction_n_m = 0, damping_n_m_s = 0;
  int joints = 0;
  for (const Joint& joint : entity.joints) {
    joints += has_own(joint) ? 1 : 0;
    friction_n_m = std::max(friction_n_m, joint.friction_n_m);
    damping_n_m_s = std::max(damping_n_m_s, joint.damping_n_m_s);
  }
  return fmt::format("friction of {} joints in the file (up to {:.3g} N m and {:.3g} N m s/rad)",
                     joints, friction_n_m, damping_n_m_s);
}

}  // namespace

void choose_friction(const Facts& facts, Entity& entity) {
  if (std::none_of(entity.joints.begin(), entity.joints.end(), has_own)) return;
  const std::string what = what_the_file_has(entity);
  if (!facts.friction) {
    entity.notes.push_back(what +
                           " is added to that of the servo types: if both mean the gears it counts "
                           "twice; <verp:friction from=\"servo\"/> or \"file\" chooses");
    return;
  }
  if (*facts.friction == FrictionFrom::kBoth) {
    entity.notes.push_back(what + " is added to that of the servo types");
    return;
  }
  const bool from_servo = *facts.friction == FrictionFrom::kServo;
  entity.notes.push_back(what + (from_servo ? " is not used: the servo types' is"
                                            : " is used there in place of the servo types'"));
  for (Joint& joint : entity.joints) {
    if (!from_servo && has_own(joint)) drop(joint.servo.gearbox);
    if (from_servo) joint.friction_n_m = joint.damping_n_m_s = 0;
  }
}

}  // namespace verp::model
