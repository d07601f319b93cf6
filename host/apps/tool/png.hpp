#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace verp::tool {

/// Encodes rgb rows, from the top, as a PNG file. It does not compress, because that would need a
/// library that this program uses nowhere else.
std::string png_of_rgb(std::uint32_t width_px, std::uint32_t height_px,
                       std::span<const std::uint8_t> rgb);

}  // namespace verp::tool
