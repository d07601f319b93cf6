#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/bus/register_names.hpp"
#include "host/tool/json.hpp"

/// A register's bytes and what people write for them.
namespace verp::tool {

/// Numbers as they are, text as text; several elements with a space between.
std::string show_value(const bus::NamedRegister& reg, const std::vector<std::uint8_t>& bytes);
Json json_value(const bus::NamedRegister& reg, const std::vector<std::uint8_t>& bytes);

/// One word for each element, decimal or 0x...; throws ToolError with the range.
std::vector<std::uint8_t> parse_values(const bus::NamedRegister& reg,
                                       const std::vector<std::string>& words);

}  // namespace verp::tool
