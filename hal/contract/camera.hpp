#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// Camera: a source of pictures that runs by itself.
///
/// A backend promises:
///  - read(frame): the newest whole picture, or why there is none. Never waits. Only kFresh changes
///    the frame. A second read of a picture is kStale.
///  - The backend owns the bytes, which stay valid until the next read that is not kStale, or its
///    end.
///  - Rows run from the top, pixels from the left; `stride_bytes` from row to row may exceed a
///    row's bytes (0: compressed). size_bytes is the whole picture.
///  - sequence counts the sensor's frames, lost those that the reader missed or that were
///    incomplete: sequence = last sequence + lost + 1, modulo 2^32, unless the camera restarts.
///  - time_us: capture time by the PC's monotonic or the twin's simulated clock; it rises.
///  - After kFault (unplugged, driver failed) later reads retry. faults() counts kFault reads,
///    modulo 2^32.
///  - No call throws.
namespace verp::hal {

enum class PixelFormat : std::uint8_t {
  kNone,
  kGrey,  ///< one byte a pixel
  kRgb,   ///< three bytes: red, green, blue
  kYuyv,  ///< two pixels, four bytes: Y, Cb, Y, Cr (BT.601: Y 16 to 235, C 16 to 240)
  kJpeg,
  kPng
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
