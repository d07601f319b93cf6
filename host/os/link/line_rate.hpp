#pragma once
#include <cstdint>

namespace verp::link {

/// Any rate of the adapter, and reads the actual one; libserial can do neither.
bool set_line_rate(int descriptor, std::uint32_t baud);
/// 0: unknown.
std::uint32_t line_rate(int descriptor);

}  // namespace verp::link
