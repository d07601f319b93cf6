#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace verp::tool {

/// Rows of red, green and blue from the top as a PNG file. Nothing is compressed: that would want a
/// library that this program needs for nothing else.
std::string png_of_rgb(std::uint32_t width_px, std::uint32_t height_px,
                       std::span<const std::uint8_t> rgb);

}  // namespace verp::tool
