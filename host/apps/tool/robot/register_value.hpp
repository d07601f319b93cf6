#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/twin/bus/register_names.hpp"

namespace verp::tool {

/// Numbers as decimals, text as it is; elements separated by spaces.
std::string show_value(const bus::NamedRegister& reg, const std::vector<std::uint8_t>& bytes);
/// "120 x 0.1 V = 12 V"; unchanged without a unit.
std::string with_unit(const std::string& shown, std::string_view unit);
cli::Json json_value(const bus::NamedRegister& reg, const std::vector<std::uint8_t>& bytes);

/// One word per element, decimal or 0x...; throws ToolError with the range.
std::vector<std::uint8_t> parse_values(const bus::NamedRegister& reg,
                                       const std::vector<std::string>& words);

}  // namespace verp::tool
