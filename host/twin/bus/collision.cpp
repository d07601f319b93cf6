#include "host/twin/bus/collision.hpp"

#include <algorithm>

namespace verp::bus {
namespace {

constexpr std::size_t kDataBits = 8;
constexpr std::size_t kFrameBits = 1 + kDataBits + 1;  // start, data (lowest bit first), stop

std::vector<bool> line_of(const std::vector<Voice>& voices) {
  std::size_t bits = 0;
  for (const Voice& each : voices) {
    bits = std::max(bits, each.late_bits + each.bytes.size() * kFrameBits);
  }
  std::vector<bool> high(bits, true);
  for (const Voice& each : voices) {
    for (std::size_t i = 0; i < each.bytes.size(); ++i) {
      const std::size_t start = each.late_bits + i * kFrameBits;
      high[start] = false;
      for (std::size_t bit = 0; bit < kDataBits; ++bit) {
        if ((each.bytes[i] >> bit & 1) == 0) high[start + 1 + bit] = false;
      }
    }
  }
  return high;
}

}  // namespace

std::vector<std::uint8_t> heard(const std::vector<Voice>& voices) {
  if (voices.size() == 1) return voices.front().bytes;
  const std::vector<bool> high = line_of(voices);
  std::vector<std::uint8_t> bytes;
  for (std::size_t at = 0; at < high.size(); ++at) {
    if (high[at]) continue;
    unsigned byte = 0;
    for (std::size_t bit = 0; bit < kDataBits; ++bit) {
      const std::size_t sample = at + 1 + bit;
      if (sample >= high.size() || high[sample]) byte |= 1u << bit;
    }
    bytes.push_back(static_cast<std::uint8_t>(byte));
    at += kFrameBits - 1;  // a low stop bit is a framing error; the UART delivers the byte anyway
  }
  return bytes;
}

}  // namespace verp::bus
