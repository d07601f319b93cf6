#pragma once
#include <cstdint>
#include <vector>

namespace verp::bus {

/// Bytes of one of several devices that transmit together.
struct Voice {
  std::vector<std::uint8_t> bytes;
  std::uint32_t late_bits = 0;  ///< behind the first device
};

/// Bytes that a UART receives from several transmitters. The low level wins: drivers pull down more
/// strongly. Each start bit on the line begins a byte.
std::vector<std::uint8_t> heard(const std::vector<Voice>& voices);

}  // namespace verp::bus
