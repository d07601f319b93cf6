#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace verp::cli {

using Json = nlohmann::ordered_json;

void print_json(const Json& object);

void print_answer(bool as_json, const Json& object, const std::string& text);

}  // namespace verp::cli
