#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::abi {

/// A robot as both the twin and the controller want it. May be asked from any thread.
struct Loaded {
  model::Entity entity;
  Params params;
};
/// `bus` and `tuning` may be null. Throws LoadError, and Failure for tuning that is none.
Loaded load(const char* model, const char* bus, const char* tuning);

/// Throws Failure unless there is such a number of the tuning, and it may have that value.
int tuning_id_of(const std::string& name);
float tuning_value_for(int id, const std::string& name, double value);

}  // namespace verp::abi
