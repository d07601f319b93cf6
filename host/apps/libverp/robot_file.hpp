#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"
#include "host/run/scenario/scenario.hpp"

namespace verp::abi {

/// A robot for twin and controller; any thread may load it.
struct Loaded {
  model::Entity entity;
  Params params;
};
/// `bus` and `tuning` may be null. Throws LoadError, and Failure for invalid tuning.
Loaded load(const char* model, const char* bus, const char* tuning);

scenario::Robot robot_of(const char* model, const char* bus, const char* tuning);
model::Entity load(const scenario::Robot& robot);

/// Throw Failure for an unknown name and a value out of range.
int tuning_id_of(const std::string& name);
float tuning_value_for(int id, const std::string& name, double value);

}  // namespace verp::abi
