#pragma once
#include <string>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Output of `verp check` for a robot: limbs, links, masses, limits, servos, leg solver, bus load.
/// For people, or as one JSON object.
std::string describe(const Entity& entity);
std::string describe_json(const Entity& entity);

/// `verp check MODEL [--json]`: prints to standard output and returns 0. Throws LoadError for an
/// invalid robot; the caller prints it and exits with 2.
int check_command(const std::string& name_or_path, const std::string& bus, bool json);

}  // namespace verp::model
