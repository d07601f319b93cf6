#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::identify {

/// A servo parameter that a motion can determine.
struct Number {
  const char* name;  ///< attribute name in <verp:servo_type>
  const char* unit;
  const char* meaning;
  double (*get)(const model::Servo& servo);
  void (*set)(model::Servo& servo, double value);
  /// A large change of the number for that servo; the fit's difference steps are parts of it.
  double (*scale)(const model::Servo& servo);
  double low, high;  ///< bounds in a robot file
};

/// All numbers, in the order of reports. Where a motion shows only a sum or product, one number
/// stands for it: the stall torque also for the supply and the P gain, the no-load speed also for
/// all drag that grows with speed.
const std::vector<Number>& numbers();

void set_number(model::Entity& entity, const std::string& type, const Number& number, double value);

/// The first servo of that type; null: the robot has none.
const model::Servo* servo_of(const model::Entity& entity, const std::string& type);
/// Each type once, in joint order.
std::vector<std::string> types_of(const model::Entity& entity);

}  // namespace verp::identify
