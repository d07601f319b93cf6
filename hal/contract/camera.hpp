#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// Camera: a source of pictures that runs by itself.
///
/// A backend promises:
///  - read(frame): returns the newest whole picture, or why there is none. Never waits. Only kFresh
///    changes the frame. A second read of the same picture is kStale.
///  - The backend owns the bytes. They stay valid until the next read that is not kStale, or until
///    the backend ends; the caller copies what it needs longer.
///  - Rows run from the top, pixels from the left. `stride_bytes` is the distance between rows and
///    may exceed the row's bytes. A compressed picture has stride 0. size_bytes covers the whole
///    picture.
///  - sequence counts the frames that the sensor made; lost counts those that the reader missed
///    since its last frame: sequence = last sequence + lost + 1, modulo 2^32, unless the camera
///    restarts. An incomplete picture counts as lost.
///  - time_us is when the sensor captured the frame, by the PC's monotonic clock or the twin's
///    simulated clock. It rises from frame to frame.
///  - After kFault (unplugged, driver failed) later reads retry. faults() counts the reads that
///    returned kFault, modulo 2^32.
///  - No call throws.
/// Implementations: hal/fake/scripted_camera.hpp, host/link/v4l2_camera.hpp (Linux),
/// host/camera/twin_camera.hpp (the twin). User: host/tool/camera_command.cpp.
namespace verp::hal {

enum class PixelFormat : std::uint8_t {
  kNone,
  kGrey,  ///< one byte a pixel
  kRgb,   ///< three bytes: red, green, blue
  kYuyv,  ///< two pixels in four bytes: Y, Cb, Y, Cr (BT.601: Y 16 to 235, C 16 to 240)
  kJpeg,  ///< a JPEG file
  kPng    ///< a PNG file
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

/// Bytes of pixels in a row, without padding; 0 for compressed formats.
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
