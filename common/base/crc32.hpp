#pragma once
#include <cstddef>
#include <cstdint>

namespace verp {

/// CRC-32 as in zip (reflected 0x04C11DB7). Continues from `previous`.
std::uint32_t crc32(const void* bytes, std::size_t size, std::uint32_t previous = 0);

}  // namespace verp
