#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "hal/contract/camera.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/os/link/video_calls.hpp"

namespace verp::link {

struct VideoFormat {
  std::string code;   ///< four characters, "YUYV"
  std::string name;   ///< the driver's description
  std::string sizes;  ///< "640x480 320x240", "16x16 to 1920x1080"; may be empty
  hal::PixelFormat format = hal::PixelFormat::kNone;  ///< kNone: not supported here
};

/// The request; 0 and kNone: the device's own.
struct VideoWish {
  std::uint32_t width_px = 0, height_px = 0;
  double rate_hz = 0;
  hal::PixelFormat format = hal::PixelFormat::kNone;
};

/// A V4L2 camera (<linux/videodev2.h>, mapped buffers) as hal/contract/camera.hpp. It starts in the
/// constructor, and again after it was unplugged.
class V4l2Camera {
 public:
  using Now = std::uint64_t (*)();  ///< ns; monotonic
  /// Throws LinkError: missing, permission, busy, no camera, unsupported picture.
  V4l2Camera(std::string device, const VideoWish& wish, VideoCalls& calls = kernel_video_calls(),
             Now now = monotonic_ns);
  ~V4l2Camera();
  V4l2Camera(const V4l2Camera&) = delete;
  V4l2Camera& operator=(const V4l2Camera&) = delete;

  // Camera
  hal::CameraStatus read(hal::CameraFrame& frame);
  std::uint32_t faults() const { return faults_; }

  void wait(int time_ms);
  std::vector<VideoFormat> formats() const;
  /// The driver's name for the camera.
  const std::string& card() const { return card_; }
  std::uint32_t width_px() const { return width_px_; }
  std::uint32_t height_px() const { return height_px_; }
  hal::PixelFormat format() const { return format_; }
  double rate_hz() const { return rate_hz_; }  ///< 0: unknown
  /// Incomplete pictures, and pictures that the driver marked as damaged.
  std::uint32_t damaged() const { return damaged_; }
  /// Why the camera is lost; empty: it works.
  const std::string& trouble() const { return trouble_; }

 private:
  struct Buffer {
    std::uint8_t* bytes = nullptr;
    std::size_t size = 0;
  };
  void open();
  void close();
  void require_camera();
  void choose_format();
  void choose_rate();
  void map_buffers();
  void start();
  bool give_back(std::uint32_t index);
  int take_newest(hal::CameraFrame& frame);
  bool try_again();
  [[noreturn]] void refuse(int error, const std::string& what) const;
  int ask(unsigned long request, void* argument) {
    return calls_.ioctl(descriptor_, request, argument);
  }

  const std::string device_;
  const VideoWish wish_;
  VideoCalls& calls_;
  const Now now_;
  int descriptor_ = -1;
  std::string card_, trouble_;
  std::uint32_t width_px_ = 0, height_px_ = 0, stride_bytes_ = 0;
  hal::PixelFormat format_ = hal::PixelFormat::kNone;
  double rate_hz_ = 0;
  std::vector<Buffer> buffers_;
  int held_ = -1;
  std::uint32_t next_sequence_ = 0;
  std::uint64_t last_us_ = 0, retry_ns_ = 0;
  std::uint32_t faults_ = 0, damaged_ = 0;
};

static_assert(hal::Camera<V4l2Camera>);

}  // namespace verp::link
