#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/twin/bus/register_names.hpp"

/// Converts between a register's bytes and text.
namespace verp::tool {

/// Numbers as decimals, text as text; elements separated by spaces.
std::string show_value(const bus::NamedRegister& reg, const std::vector<std::uint8_t>& bytes);
/// "120 x 0.1 V = 12 V", "35 deg C"; unchanged if there is no unit.
std::string with_unit(const std::string& shown, std::string_view unit);
cli::Json json_value(const bus::NamedRegister& reg, const std::vector<std::uint8_t>& bytes);

/// One word per element, decimal or 0x...; throws ToolError that names the range.
std::vector<std::uint8_t> parse_values(const bus::NamedRegister& reg,
                                       const std::vector<std::string>& words);

}  // namespace verp::tool
