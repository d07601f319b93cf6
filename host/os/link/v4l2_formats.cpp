#include "host/os/link/v4l2_formats.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace verp::link::v4l2 {
namespace {

hal::PixelFormat format_of(std::uint32_t code) {
  const auto found = std::find_if(kCodes.begin(), kCodes.end(),
                                  [&](const Code& each) { return each.code == code; });
  return found == kCodes.end() ? hal::PixelFormat::kNone : found->format;
}

/// Lowest byte first; a dot stands for an unprintable character.
std::string fourcc_text(std::uint32_t code) {
  std::string text;
  for (int shift = 0; shift < 32; shift += 8) {
    const char letter = static_cast<char>(code >> shift & 0x7F);
    text += letter > ' ' && letter < '\x7F' ? letter : '.';
  }
  return text;
}

/// The driver lists sizes, a range or nothing.
std::string sizes_of(VideoCalls& calls, int descriptor, std::uint32_t code) {
  std::vector<std::string> sizes;
  for (std::uint32_t i = 0; i < 100; ++i) {
    v4l2_frmsizeenum size{};
    size.index = i;
    size.pixel_format = code;
    if (calls.ioctl(descriptor, VIDIOC_ENUM_FRAMESIZES, &size) < 0) break;
    if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) {
      return fmt::format("{}x{} to {}x{}", size.stepwise.min_width, size.stepwise.min_height,
                         size.stepwise.max_width, size.stepwise.max_height);
    }
    sizes.push_back(fmt::format("{}x{}", size.discrete.width, size.discrete.height));
  }
  return fmt::format("{}", fmt::join(sizes, " "));
}

}  // namespace

std::vector<Listed> listed_formats(VideoCalls& calls, int descriptor) {
  std::vector<Listed> formats;
  for (std::uint32_t i = 0; i < 100; ++i) {
    v4l2_fmtdesc format{};
    format.index = i;
    format.type = kCapture;
    if (calls.ioctl(descriptor, VIDIOC_ENUM_FMT, &format) < 0) break;
    formats.push_back(
        {{fourcc_text(format.pixelformat), text_of(format.description),
          sizes_of(calls, descriptor, format.pixelformat), format_of(format.pixelformat)},
         format.pixelformat});
  }
  return formats;
}

std::string in_one_line(const std::vector<Listed>& formats) {
  std::vector<std::string> words;
  for (const Listed& each : formats)
    words.push_back(each.shown.code + (each.shown.sizes.empty() ? "" : " " + each.shown.sizes));
  return words.empty() ? "nothing" : fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace verp::link::v4l2
