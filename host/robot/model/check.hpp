#pragma once
#include <string>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// What `verp check` says of a robot: limbs, links, masses, limits, servos, leg solver, bus load.
/// For people, or as one JSON object.
std::string describe(const Entity& entity);
std::string describe_json(const Entity& entity);

/// `verp check MODEL [--json]`: prints it on standard output. Throws LoadError for a robot that is
/// not sound (the caller prints it and exits with 2); else returns 0.
int check_command(const std::string& name_or_path, const std::string& bus, bool json);

}  // namespace verp::model
