#include "common/base/crc32.hpp"

namespace verp {

std::uint32_t crc32(const void* bytes, std::size_t size, std::uint32_t previous) {
  const auto* byte = static_cast<const unsigned char*>(bytes);
  std::uint32_t crc = ~previous;
  for (std::size_t i = 0; i < size; ++i) {
    crc ^= byte[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0u ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

}  // namespace verp
