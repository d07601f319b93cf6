#pragma once
#include <cstdint>
#include <string>

namespace verp::tool {

/// The trouble that the register `brown_out` reports, with its remedy; empty: no trouble.
std::string brown_out_complaint(std::uint8_t brown_out);

}  // namespace verp::tool
