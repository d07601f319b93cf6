#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

/// The controller's constants of this robot: single precision, fixed capacity, all defaults filled
/// in. Throws LoadError for more than 4 kinds of servo settings, names over 23 characters, or an
/// unknown or out-of-range tuning value.
Params make_params(const Entity& entity);

/// Stiffness of the servo's position loop, N m/rad: duty grows by p/128 of 1/885 a count, and
/// torque follows duty.
double servo_stiffness_n_m_rad(const Servo& servo);

/// Index of a tuning value ("gait.lift_m") in field order (tuning_ranges.hpp).
std::optional<int> tuning_id(const std::string& name);
/// All names in that order.
const std::vector<std::string>& tuning_names();

}  // namespace verp::model
