#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/author/import/finding.hpp"

/// Which servos an imported robot gets.
namespace verp::import {

/// What a file says of one joint's motor, seen from the joint. 0: it does not say.
struct Drive {
  double stall_torque_n_m = 0;  ///< the most it gives; without it the joint has no drive
  double no_load_rad_s = 0;
  bool is_line = false;  ///< its torque falls evenly to nothing there; else it is a current's limit
  double armature_kg_m2 = 0;
  double friction_n_m = 0, damping_n_m_s = 0;
  double kp_n_m_rad = 0;  ///< said, not taken: VERP's gain fits mass and legs
};

struct ServoJoint {
  std::string name;
  std::optional<Drive> drive = {};
  Drive limit = {};  ///< URDF's <limit effort velocity>: in many files a placeholder
};

struct ServoChoice {
  std::string protocol = "dynamixel2";
  std::vector<std::string> types;      ///< of the joints, in their order
  std::vector<std::string> own_types;  ///< <verp:servo_type> elements
  std::vector<Finding> findings;
};

constexpr double kTorqueReserve = 2;  ///< walking over standing: `needed_n_m` has it

/// `wished` (--servos) is for all joints. Else joints with equal drives share a type `motor_1`,
/// ...; the others get the weakest known type with `needed_n_m`, or a `motor` of that torque.
/// Limits are drives if no joint has one and they are those of motors stronger than all known
/// servos. Throws LoadError if there is no type `wished`.
ServoChoice choose_servo_types(const std::vector<ServoJoint>& joints, const std::string& wished,
                               double needed_n_m);

}  // namespace verp::import
