#pragma once
#include <string>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// As text or one JSON object, each with a line's end.
std::string describe(const Entity& entity);
std::string describe_json(const Entity& entity);

}  // namespace verp::model
