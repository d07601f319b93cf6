#pragma once
#include <cstdint>
#include <string>

namespace verp::tool {

/// What the register `brown_out` of a controller says that needs a person, with the remedy; empty:
/// nothing.
std::string brown_out_complaint(std::uint8_t brown_out);

}  // namespace verp::tool
