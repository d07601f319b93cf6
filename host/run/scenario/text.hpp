#pragma once
#include <optional>
#include <string>

#include "host/run/scenario/scenario.hpp"

/// A Scenario as a JSON file.
namespace verp::scenario {

/// Prints every field, also those with their default.
std::string print(const Scenario& scenario);

/// Missing fields keep their default. Throws model::LoadError that names `file` and the key if a
/// key is unknown or a value has the wrong type or is out of range.
Scenario parse(const std::string& text, const std::string& file);
Scenario read(const std::string& file);

/// Reads "standing", "lying:front" and so on; empty for any other name.
std::optional<sim::Lies> start_of(const std::string& name);

}  // namespace verp::scenario
