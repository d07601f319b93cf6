#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/twin/bus/register_names.hpp"

/// A register's bytes and what people write for them.
namespace verp::tool {

/// Numbers as they are, text as text; several elements with a space between.
std::string show_value(const bus::NamedRegister& reg, const std::vector<std::uint8_t>& bytes);
/// "120 x 0.1 V = 12 V", "35 deg C"; a value without a unit is itself.
std::string with_unit(const std::string& shown, std::string_view unit);
cli::Json json_value(const bus::NamedRegister& reg, const std::vector<std::uint8_t>& bytes);

/// One word for each element, decimal or 0x...; throws ToolError with the range.
std::vector<std::uint8_t> parse_values(const bus::NamedRegister& reg,
                                       const std::vector<std::string>& words);

}  // namespace verp::tool
