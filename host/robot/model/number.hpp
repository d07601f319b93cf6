#pragma once
#include <optional>
#include <string_view>
#include <vector>

namespace verp::model {

/// One finite decimal number; nothing for "1,0x", "1 2", "", "nan" or "inf". Independent of the
/// locale.
std::optional<double> parse_number(std::string_view text);

/// White-space separated numbers; nothing if one is invalid.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

/// With or without sign; SDF allows it for some limits.
bool is_infinity(std::string_view text);

}  // namespace verp::model
