#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// Camera: pictures, one after the other, from something that makes them by itself.
///
/// Promises of a backend:
///  - read(frame): the newest whole picture, or says why there is none. Never waits. Only kFresh
///    changes the frame, and no picture is given twice: the second read of it is kStale.
///  - The bytes stay the backend's. They stand still until the next read that is not kStale, or the
///    backend's end: who wants them longer copies them.
///  - Rows are from the top, pixels from the left, `stride_bytes` from row to row, of which the
///    picture's may be fewer. A compressed picture has no rows: its stride is 0. size_bytes is all
///    of it, and never less than the picture needs.
///  - sequence counts what the sensor made, and lost how many of those nobody got since the frame
///    before: sequence is the last one's plus lost plus one, modulo 2^32, but where the camera
///    starts anew. A picture that came in part is lost.
///  - time_us is when the sensor had it (not when it was read). Its clock never goes back: the PC's
///    monotonic one, or the twin's simulated one. It rises from frame to frame.
///  - After kFault (unplugged, or its driver failed) the backend tries again by itself in later
///    reads. faults() counts the reads that said so, modulo 2^32.
///  - No call throws.
/// Implementations: hal/fake/scripted_camera.hpp, host/link/v4l2_camera.hpp (Linux),
/// host/camera/twin_camera.hpp (the twin's). User: host/tool/camera_command.cpp.
namespace verp::hal {

enum class PixelFormat : std::uint8_t {
  kNone,
  kGrey,  ///< one byte a pixel
  kRgb,   ///< three: red, green, blue
  kYuyv,  ///< two pixels in four bytes: Y, Cb, Y, Cr of BT.601, 16 to 235 and 16 to 240
  kJpeg,  ///< a file of that kind
  kPng    ///< likewise
};

struct CameraFrame {
  std::uint32_t width_px = 0, height_px = 0;
  PixelFormat format = PixelFormat::kNone;
  std::uint32_t stride_bytes = 0;
  std::uint32_t sequence = 0, lost = 0;
  std::uint64_t time_us = 0;
  const std::uint8_t* data = nullptr;
  std::size_t size_bytes = 0;
};

/// Of a row of pixels without what may stand behind it; 0: compressed, there are no rows.
constexpr std::uint32_t row_bytes(PixelFormat format, std::uint32_t width_px) {
  switch (format) {
    case PixelFormat::kGrey:
      return width_px;
    case PixelFormat::kRgb:
      return 3 * width_px;
    case PixelFormat::kYuyv:
      return 2 * width_px;
    default:
      return 0;
  }
}

enum class CameraStatus : std::uint8_t { kFresh = 0, kStale = 1, kFault = 2 };

template <class Source>
concept Camera = requires(Source& source, const Source& seen, CameraFrame& frame) {
  { source.read(frame) } -> std::same_as<CameraStatus>;
  { seen.faults() } -> std::same_as<std::uint32_t>;
};

}  // namespace verp::hal
