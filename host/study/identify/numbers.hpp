#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::identify {

struct Number {
  const char* name;  ///< attribute name in <verp:servo_type>
  const char* unit;
  const char* meaning;
  double (*get)(const model::Servo& servo);
  void (*set)(model::Servo& servo, double value);
  /// A large change; difference steps are parts of it.
  double (*scale)(const model::Servo& servo);
  double low, high;  ///< in a robot file
};

/// In the order of reports. Where a motion shows only a sum or product, one number stands for it:
/// stall torque for supply and P gain, no-load speed for all drag that grows with speed.
const std::vector<Number>& numbers();

void set_number(model::Entity& entity, const std::string& type, const Number& number, double value);

/// Null: there is no such servo.
const model::Servo* servo_of(const model::Entity& entity, const std::string& type);
std::vector<std::string> types_of(const model::Entity& entity);

}  // namespace verp::identify
