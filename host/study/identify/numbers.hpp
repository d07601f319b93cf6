#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::identify {

/// One number of a servo that a motion may tell.
struct Number {
  const char* name;  ///< as in <verp:servo_type>
  const char* unit;
  const char* meaning;
  double (*get)(const model::Servo& servo);
  void (*set)(model::Servo& servo, double value);
  /// What of it is much, for that servo: by parts of this it is tried.
  double (*scale)(const model::Servo& servo);
  double low, high;  ///< as the robot's file may have it
};

/// All of them, in the order in which they are told. Of what only their sum or product can be seen,
/// one is here: the stall torque stands for the supply and the P gain too, the no-load speed for
/// all that grows with speed.
const std::vector<Number>& numbers();

/// Gives it to all servos of that type.
void set_number(model::Entity& entity, const std::string& type, const Number& number, double value);

/// Of that type, the first servo; null: the robot has none.
const model::Servo* servo_of(const model::Entity& entity, const std::string& type);
/// In the order of its joints, each once.
std::vector<std::string> types_of(const model::Entity& entity);

}  // namespace verp::identify
