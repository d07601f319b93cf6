#pragma once
#include <optional>
#include <string>

#include "host/run/scenario/scenario.hpp"

namespace verp::scenario {

/// Prints every field, also those with their default.
std::string print(const Scenario& scenario);

/// Missing fields keep their default. Throws model::LoadError with `file` and key for an unknown
/// key, a wrong type or range.
Scenario parse(const std::string& text, const std::string& file);
/// Also throws for a robot, world or controller that is not there.
Scenario read(const std::string& file);

/// A robot's name may have letters, digits, _ and -.
bool is_name(const std::string& text);

/// "standing", "lying:front" and so on; else empty.
std::optional<sim::Lies> start_of(const std::string& name);

}  // namespace verp::scenario
