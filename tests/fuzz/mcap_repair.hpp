#pragma once
#include <algorithm>
#include <cstring>
#include <string>

#include "host/trace/record/mcap_format.hpp"

namespace verp::fuzz {

/// Writes the right checksums into a changed MCAP file, as far as its records can be followed.
inline void repair_mcap(std::string& file) {
  using record::mcap::crc32;
  using record::mcap::Opcode;
  const auto u64_at = [&](std::size_t at) {
    std::uint64_t value = 0;
    std::memcpy(&value, file.data() + at, std::min(sizeof value, file.size() - at));
    return value;
  };
  const auto put = [&](std::size_t at, std::uint32_t value) {
    if (at + sizeof value <= file.size()) std::memcpy(file.data() + at, &value, sizeof value);
  };
  const auto sum = [&](std::size_t from, std::size_t size) {
    return crc32(std::string_view(file).substr(std::min(from, file.size()), size));
  };
  std::size_t summary = 0;
  for (std::size_t at = record::mcap::kMagic.size(); at + 9 < file.size();) {
    const auto opcode = static_cast<Opcode>(file[at]);
    const std::uint64_t length = u64_at(at + 1);
    const std::size_t first = at + 9;
    if (length > file.size() - first) return;
    const std::size_t end = first + length;
    // A chunk: two times, size, CRC at 24; then an empty name of its compression, size, records.
    if (opcode == Opcode::kChunk && length >= 40 && u64_at(first + 28) << 32 == 0)
      put(first + 24, sum(first + 40, end - first - 40));
    if (opcode == Opcode::kAttachment && length >= 4) put(end - 4, sum(first, length - 4));
    if (opcode == Opcode::kDataEnd && length == 4) put(first, sum(0, at));
    if (opcode == Opcode::kDataEnd) summary = end;
    if (opcode == Opcode::kFooter && length == 20)
      put(first + 16, sum(summary, first + 16 - summary));
    at = end;
  }
}

}  // namespace verp::fuzz
