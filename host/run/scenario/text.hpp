#pragma once
#include <optional>
#include <string>

#include "host/run/scenario/scenario.hpp"

/// A Scenario as a JSON file.
namespace verp::scenario {

/// Every field, whether or not it is as by default.
std::string print(const Scenario& scenario);

/// Fields that are not there are as by default. Throws model::LoadError that names `file` and the
/// key for a key that no field has, a value of another type, or one out of range.
Scenario parse(const std::string& text, const std::string& file);
Scenario read(const std::string& file);

/// "standing", "lying:front" and so on; empty: it is none of them.
std::optional<sim::Lies> start_of(const std::string& name);

}  // namespace verp::scenario
