#include "host/twin/sim/coupling.hpp"

#include <algorithm>

namespace verp::sim {
namespace {

/// As stiff as an end stop; softer in steps above 1 ms, where it would diverge.
struct Coupling {
  explicit Coupling(double step_s) {
    constexpr double kStep_s = 0.001, kStiffness_n_m = 500.0, kDamping_n_m_s = 1.0;
    const double softer = std::min(1.0, kStep_s / step_s);
    stiffness_n_m = softer * softer * kStiffness_n_m;
    slope_n_m_s = softer * kDamping_n_m_s + step_s * stiffness_n_m;
  }
  double stiffness_n_m;
  double slope_n_m_s;  ///< over the joint's own new speed
};

}  // namespace

void lead(const model::Entity& entity, std::vector<double>& joint_rad) {
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    const model::Joint& joint = entity.joints[j];
    if (joint.follows < 0) continue;
    joint_rad[j] =
        joint.ratio * joint_rad[static_cast<std::size_t>(joint.follows)] + joint.offset_rad;
  }
}

model::Joint joint_at_servo(const model::Entity& entity, std::size_t j, double step_s) {
  model::Joint joint = entity.joints[j];
  if (joint.follows >= 0) {
    joint.servo.gearbox = model::Gearbox{};
    joint.servo.backlash_rad = 0;
  }
  double& armature_kg_m2 = joint.servo.gearbox.armature_kg_m2;
  for (const model::Joint& other : entity.joints) {
    if (other.follows != static_cast<int>(j)) continue;
    const double carried = 2 * other.ratio * other.ratio * step_s * Coupling(step_s).slope_n_m_s;
    armature_kg_m2 = std::max(armature_kg_m2 - carried, 0.0);
  }
  return joint;
}

std::vector<Drive> couplings(const model::Entity& entity, const Body& body, double step_s) {
  std::vector<Drive> lines(entity.joints.size());
  const Coupling coupling(step_s);
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    const model::Joint& joint = entity.joints[j];
    if (joint.follows < 0) continue;
    const int own = static_cast<int>(j);
    const double driver_rad = body.angle_rad(joint.follows);
    const double pull_n_m = coupling.stiffness_n_m *
                            (body.angle_rad(own) - joint.offset_rad - joint.ratio * driver_rad);
    const double slope = coupling.slope_n_m_s;
    lines[j] += {slope * joint.ratio * body.rate_rad_s(joint.follows) - pull_n_m, slope};
    lines[static_cast<std::size_t>(joint.follows)] += {
        joint.ratio * (slope * body.rate_rad_s(own) + pull_n_m), joint.ratio * joint.ratio * slope};
  }
  return lines;
}

}  // namespace verp::sim
