// A picture's file: textures, recorded pictures. What is read is written and read alike.
#include "common/base/crc32.hpp"
#include "host/show/render/files.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace {

/// Chunks: length, name, data, CRC of name and data, big-endian.
std::string repaired(std::string file) {
  const auto swapped = [](std::uint32_t value) { return __builtin_bswap32(value); };
  for (std::size_t at = 8; at + 12 <= file.size();) {
    std::uint32_t length = 0;
    std::memcpy(&length, file.data() + at, sizeof length);
    length = swapped(length);
    if (length > file.size() - at - 12) break;
    const std::uint32_t crc = swapped(verp::crc32(file.data() + at + 4, length + 4U));
    std::memcpy(file.data() + at + 8 + length, &crc, sizeof crc);
    at += 12U + length;
  }
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::refuses_only_by<render::RenderError>([&] {
    const std::string file = repaired({reinterpret_cast<const char*>(data), size});
    const render::Image read = render::read_png("a.png", file);
    if (read.rgb.size() > 10'000) return;
    const render::Image again = render::read_png("b.png", render::png_of(read));
    fuzz::require(again.rgb == read.rgb, "a picture is read as it was written");
  });
  return 0;
}
