#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

/// A name as the controller knows it: the same up to 23 characters; of a longer one the
/// first 18 bytes, less those of a character that they cut, and a hash of all.
std::string short_name(const std::string& name);

/// Controller's constants: single precision, fixed capacity, defaults filled in. Throws LoadError
/// beyond 4 kinds of servo settings, and for unknown or out-of-range tuning.
Params make_params(const Entity& entity);

/// N m/rad: duty grows by p/128 of 1/885 a count, and torque follows.
double servo_stiffness_n_m_rad(const Servo& servo);

/// Index by name ("gait.lift_m"), in field order (tuning_ranges.hpp).
std::optional<int> tuning_id(const std::string& name);
const std::vector<std::string>& tuning_names();

}  // namespace verp::model
