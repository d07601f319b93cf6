#include "host/apps/tool/png.hpp"

#include <algorithm>

#include "common/base/crc32.hpp"

namespace verp::tool {
namespace {

void put_big(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xFF);
}

void put_chunk(std::string& out, const std::string& kind, const std::string& data) {
  put_big(out, static_cast<std::uint32_t>(data.size()));
  const std::string summed = kind + data;
  out += summed;
  put_big(out, crc32(summed.data(), summed.size()));
}

std::uint32_t adler32(const std::string& bytes) {
  constexpr std::uint32_t kPrime = 65521;
  std::uint32_t low = 1, high = 0;
  for (const char each : bytes) {
    low = (low + static_cast<unsigned char>(each)) % kPrime;
    high = (high + low) % kPrime;
  }
  return high << 16 | low;
}

/// zlib stream (RFC 1950) of stored blocks (RFC 1951, 3.2.4).
std::string stored(const std::string& bytes) {
  constexpr std::size_t kMost = 65535;
  std::string out = "\x78\x01";
  for (std::size_t at = 0; at < bytes.size(); at += kMost) {
    const std::size_t size = std::min(kMost, bytes.size() - at);
    out += static_cast<char>(at + size == bytes.size() ? 1 : 0);
    for (const std::size_t value : {size, ~size}) {
      out += static_cast<char>(value & 0xFF);
      out += static_cast<char>(value >> 8 & 0xFF);
    }
    out.append(bytes, at, size);
  }
  put_big(out, adler32(bytes));
  return out;
}

}  // namespace

std::string png_of_rgb(std::uint32_t width_px, std::uint32_t height_px,
                       std::span<const std::uint8_t> rgb) {
  const std::size_t row = std::size_t{3} * width_px;
  std::string rows;
  rows.reserve((row + 1) * height_px);
  for (std::size_t y = 0; y < height_px; ++y) {
    rows += '\0';  // no filter
    const std::span<const std::uint8_t> from = rgb.subspan(y * row, row);
    rows.append(from.begin(), from.end());
  }
  std::string head;
  put_big(head, width_px);
  put_big(head, height_px);
  head += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits per colour
  std::string out = "\x89PNG\r\n\x1a\n";
  put_chunk(out, "IHDR", head);
  put_chunk(out, "IDAT", stored(rows));
  put_chunk(out, "IEND", "");
  return out;
}

}  // namespace verp::tool
