#pragma once
#include <string>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// As text or one JSON object.
std::string describe(const Entity& entity);
std::string describe_json(const Entity& entity);

/// Prints and returns 0. Throws LoadError; the caller then exits with 2.
int check_command(const std::string& name_or_path, const std::string& bus, bool json);

}  // namespace verp::model
