#pragma once
#include <cstdint>
#include <vector>

namespace verp::bus {

/// What one of several devices says, all at the same time.
struct Voice {
  std::vector<std::uint8_t> bytes;
  std::uint32_t late_bits = 0;  ///< it begins so much after the first
};

/// What a UART makes of a line on which several devices speak: a low level wins, as drivers that
/// pull down are the stronger ones, and each start bit that the line shows begins a byte. One voice
/// comes through as it is.
std::vector<std::uint8_t> heard(const std::vector<Voice>& voices);

}  // namespace verp::bus
