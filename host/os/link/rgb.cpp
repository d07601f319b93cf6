#include "host/os/link/rgb.hpp"

#include <algorithm>
#include <cmath>

namespace verp::link {
namespace {

std::uint8_t clamped(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

/// ITU-R BT.601: 219 steps of Y and 224 of Cb and Cr.
void put_yuv(std::uint8_t* out, double y, double cb, double cr) {
  const double luma = 255.0 / 219.0 * (y - 16), blue = 255.0 / 224.0 * (cb - 128),
               red = 255.0 / 224.0 * (cr - 128);
  constexpr double kRed = 0.299, kGreen = 0.587, kBlue = 0.114;
  out[0] = clamped(luma + 2 * (1 - kRed) * red);
  out[1] = clamped(luma - 2 * (1 - kBlue) * kBlue / kGreen * blue -
                   2 * (1 - kRed) * kRed / kGreen * red);
  out[2] = clamped(luma + 2 * (1 - kBlue) * blue);
}

}  // namespace

std::vector<std::uint8_t> rgb_of(const hal::CameraFrame& frame) {
  const std::size_t row = hal::row_bytes(frame.format, frame.width_px);
  if (row == 0 || frame.height_px == 0 || frame.stride_bytes < row ||
      frame.size_bytes < std::size_t{frame.stride_bytes} * (frame.height_px - 1) + row)
    return {};
  std::vector<std::uint8_t> rgb(std::size_t{3} * frame.width_px * frame.height_px);
  std::uint8_t* out = rgb.data();
  for (std::size_t y = 0; y < frame.height_px; ++y) {
    const std::uint8_t* in = frame.data + y * frame.stride_bytes;
    for (std::size_t x = 0; x < frame.width_px; ++x, out += 3) {
      if (frame.format == hal::PixelFormat::kRgb) {
        std::copy_n(in + 3 * x, 3, out);
      } else if (frame.format == hal::PixelFormat::kGrey) {
        std::fill_n(out, 3, in[x]);
      } else {
        // The last pixel of an odd row uses the previous pair's Cr.
        const std::size_t pair = 4 * (x / 2);
        const double cr = pair + 3 < row ? in[pair + 3] : (pair >= 4 ? in[pair - 1] : 128);
        put_yuv(out, in[2 * x], in[pair + 1], cr);
      }
    }
  }
  return rgb;
}

}  // namespace verp::link
