#pragma once
#include <cstdint>
#include <vector>

namespace verp::bus {

/// Bytes from one of several devices that transmit at the same time.
struct Voice {
  std::vector<std::uint8_t> bytes;
  std::uint32_t late_bits = 0;  ///< start delay behind the first device
};

/// What a UART receives while several devices transmit. The low level wins, because drivers pull
/// down more strongly. Each start bit on the line begins a byte. A single voice arrives unchanged.
std::vector<std::uint8_t> heard(const std::vector<Voice>& voices);

}  // namespace verp::bus
