#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace verp::cli {

/// Keys keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// Writes one object and a newline to stdout.
void print_json(const Json& object);

/// To stdout, in the form that was asked for.
void print_answer(bool as_json, const Json& object, const std::string& text);

}  // namespace verp::cli
