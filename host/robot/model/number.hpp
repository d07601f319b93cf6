#pragma once
#include <optional>
#include <string_view>
#include <vector>

namespace verp::model {

/// The whole text as one finite decimal number; nothing for "1,0x", "1 2", "", "nan" or "inf".
/// Independent of the locale; libsdformat reads "1,0x" as 1.
std::optional<double> parse_number(std::string_view text);

/// White-space separated numbers; nothing if one is invalid.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

/// True for "inf" with or without a sign, which SDF allows for some limits.
bool is_infinity(std::string_view text);

}  // namespace verp::model
