#pragma once
#include <nlohmann/json.hpp>

namespace verp::tool {

/// Keys keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// Writes one object and a newline to stdout.
void print_json(const Json& object);

}  // namespace verp::tool
