#pragma once
#include <optional>
#include <string_view>
#include <vector>

namespace verp::model {

/// The whole text as one finite decimal number; nothing for "1,0x", "1 2", "", "nan" or "inf".
/// Independent of the locale, unlike libsdformat, which reads "1,0x" as 1.
std::optional<double> parse_number(std::string_view text);

/// White-space separated numbers; nothing when any of them is not one.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

/// Whether the text is "inf" with or without a sign, which SDF allows for some limits.
bool is_infinity(std::string_view text);

}  // namespace verp::model
