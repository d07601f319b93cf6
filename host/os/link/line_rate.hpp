#pragma once
#include <cstdint>

namespace verp::link {

/// What libserial cannot: any rate that the adapter can make, and which one it has made.
bool set_line_rate(int descriptor, std::uint32_t baud);
/// 0: the device doesn't say.
std::uint32_t line_rate(int descriptor);

}  // namespace verp::link
