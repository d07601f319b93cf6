#include "host/study/identify/numbers.hpp"

#include <algorithm>

namespace verp::identify {
namespace {

using model::Servo;

constexpr double kRevMin = 9.549296585513721;  ///< 1 rad/s in rev/min

/// Sets the sum and keeps the ratio.
void share(double& one, double& other, double sum) {
  const double before = one + other;
  one = before > 0 ? one * sum / before : sum;
  other = sum - one;
}

}  // namespace

const std::vector<Number>& numbers() {
  static const std::vector<Number> kNumbers = {
      {"stall_torque_n_m", "N m", "gain: torque of full duty",
       [](const Servo& s) { return s.stall_torque_n_m; },
       [](Servo& s, double v) { s.stall_torque_n_m = v; },
       [](const Servo& s) { return s.stall_torque_n_m; }, 1e-6, 1e4},
      {"no_load_rev_min", "rev/min", "speed without load",
       [](const Servo& s) { return kRevMin * s.no_load_speed_rad_s; },
       [](Servo& s, double v) { s.no_load_speed_rad_s = v / kRevMin; },
       [](const Servo& s) { return kRevMin * s.no_load_speed_rad_s; }, 1e-3, 1e5},
      {"armature_kg_m2", "kg m2", "rotor inertia",
       [](const Servo& s) { return s.gearbox.armature_kg_m2; },
       [](Servo& s, double v) { s.gearbox.armature_kg_m2 = v; },
       [](const Servo& s) { return std::max(s.gearbox.armature_kg_m2, 1e-3 * s.stall_torque_n_m); },
       0, 1e4},
      {"friction_n_m", "N m", "f_base + f_strib: what holds it at a standstill",
       [](const Servo& s) { return s.gearbox.f_base_n_m + s.gearbox.f_strib_n_m; },
       [](Servo& s, double v) { share(s.gearbox.f_base_n_m, s.gearbox.f_strib_n_m, v); },
       [](const Servo& s) {
         return std::max(s.gearbox.f_base_n_m + s.gearbox.f_strib_n_m, 0.01 * s.stall_torque_n_m);
       },
       0, 1e4},
      {"load_friction", "", "l_base + l_strib: of the load, at a standstill",
       [](const Servo& s) { return s.gearbox.l_base + s.gearbox.l_strib; },
       [](Servo& s, double v) { share(s.gearbox.l_base, s.gearbox.l_strib, v); },
       [](const Servo& s) { return std::max(s.gearbox.l_base + s.gearbox.l_strib, 0.1); }, 0, 0.95},
      {"backlash_rad", "rad", "play", [](const Servo& s) { return s.backlash_rad; },
       [](Servo& s, double v) { s.backlash_rad = v; },
       [](const Servo& s) { return std::max(s.backlash_rad, 0.004); }, 0, 0.1},
  };
  return kNumbers;
}

void set_number(model::Entity& entity, const std::string& type, const Number& number,
                double value) {
  for (model::Joint& joint : entity.joints) {
    if (joint.servo.type == type) number.set(joint.servo, value);
  }
}

const Servo* servo_of(const model::Entity& entity, const std::string& type) {
  for (const model::Joint& joint : entity.joints) {
    if (joint.servo.type == type) return &joint.servo;
  }
  return nullptr;
}

std::vector<std::string> types_of(const model::Entity& entity) {
  std::vector<std::string> types;
  for (const model::Joint& joint : entity.joints) {
    if (std::find(types.begin(), types.end(), joint.servo.type) == types.end())
      types.push_back(joint.servo.type);
  }
  return types;
}

}  // namespace verp::identify
