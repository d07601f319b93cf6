#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace verp::tool {

/// rgb rows from the top, as an uncompressed PNG file: no other code here needs a compressor.
std::string png_of_rgb(std::uint32_t width_px, std::uint32_t height_px,
                       std::span<const std::uint8_t> rgb);

}  // namespace verp::tool
