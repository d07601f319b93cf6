#pragma once
#include <linux/videodev2.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "hal/contract/camera.hpp"
#include "host/os/link/v4l2_camera.hpp"
#include "host/os/link/video_calls.hpp"

/// Formats of a device that this code reads. Private to this folder.
namespace verp::link::v4l2 {

inline constexpr std::uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;

struct Code {
  std::uint32_t code;
  hal::PixelFormat format;
};
/// In order of preference: lossless and colour first.
inline constexpr std::array kCodes = {Code{V4L2_PIX_FMT_YUYV, hal::PixelFormat::kYuyv},
                                      Code{V4L2_PIX_FMT_RGB24, hal::PixelFormat::kRgb},
                                      Code{V4L2_PIX_FMT_GREY, hal::PixelFormat::kGrey},
                                      Code{V4L2_PIX_FMT_MJPEG, hal::PixelFormat::kJpeg},
                                      Code{V4L2_PIX_FMT_JPEG, hal::PixelFormat::kJpeg}};

template <std::size_t kSize>
std::string text_of(const __u8 (&bytes)[kSize]) {
  const char* text = reinterpret_cast<const char*>(bytes);
  return {text, ::strnlen(text, kSize)};
}

struct Listed {
  VideoFormat shown;
  std::uint32_t code = 0;
};
std::vector<Listed> listed_formats(VideoCalls& calls, int descriptor);
std::string in_one_line(const std::vector<Listed>& formats);

}  // namespace verp::link::v4l2
