#pragma once
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "host/os/link/rgb.hpp"
#include "host/os/link/v4l2_camera.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/show/camera/twin_camera.hpp"
#include "host/twin/sim/world.hpp"
#include "tests/support/video_device.hpp"

namespace verp::test {

template <std::uint32_t kCode>
struct KernelEyeOf {
  static constexpr std::uint32_t kWidth = 16, kHeight = 8;
  static constexpr bool kBreaks = true;
  static VideoDevice made() {
    VideoDevice device;
    device.formats = {{kCode, {{kWidth, kHeight}}}};
    device.padding = 6;
    return device;
  }
  void show() { device.make_picture(); }
  bool is(const hal::CameraFrame& frame, std::uint32_t number) const {
    if (frame.format == hal::PixelFormat::kJpeg) return frame.data[2] == number;
    const std::vector<std::uint8_t> rgb = link::rgb_of(frame);
    for (std::uint32_t pixel = 0; pixel < kWidth * kHeight; ++pixel) {
      const int expected = pixel % kWidth == device.bar_of(number) ? 255 : 0;
      for (std::uint32_t i = 0; i < 3; ++i) {
        if (rgb.at(3 * pixel + i) != expected) return false;
      }
    }
    return true;
  }
  void break_it(bool unplugged) { unplugged ? device.unplug() : device.plug(); }
  void wait() { time_ns += 300'000'000; }
  hal::CameraStatus read(hal::CameraFrame& frame) { return camera.read(frame); }
  std::uint32_t faults() const { return camera.faults(); }
  static std::uint64_t now_ns() { return time_ns; }

  inline static std::uint64_t time_ns = 1;
  VideoDevice device = made();
  link::V4l2Camera camera{device.path, {}, device, now_ns};
};
using KernelEye = KernelEyeOf<V4L2_PIX_FMT_YUYV>;
using KernelEyeOfFiles = KernelEyeOf<V4L2_PIX_FMT_MJPEG>;

/// Draws the number of the moment.
class NumberDrawer {
 public:
  void expose(const camera::Moment& moment) { waiting_.push_back(moment); }
  std::vector<camera::Picture> take() {
    if (waiting_.empty()) return {};
    const camera::Moment moment = std::move(waiting_.front());
    waiting_.pop_front();
    return {{.camera = moment.cameras.at(0),
             .time_us = moment.time_us,
             .width = 320,
             .height = 240,
             .encoding = "png",
             .data = "picture " + std::to_string(made_++)}};
  }

 private:
  std::deque<camera::Moment> waiting_;
  std::uint32_t made_ = 0;
};

/// tests/host/camera tests the renderer.
struct TwinEye {
  static constexpr std::uint32_t kWidth = 320, kHeight = 240;
  static constexpr bool kBreaks = false;

  void show() { world.advance_to(34'000 * ++shown); }
  bool is(const hal::CameraFrame& frame, std::uint32_t number) const {
    return std::string(reinterpret_cast<const char*>(frame.data), frame.size_bytes) ==
           "picture " + std::to_string(number);
  }
  void break_it(bool) {}
  void wait() {}
  hal::CameraStatus read(hal::CameraFrame& frame) { return camera.read(frame); }
  std::uint32_t faults() const { return camera.faults(); }

  std::uint64_t shown = 0;
  sim::World world;
  sim::TwinRobot twin{world,
                      model::load_robot(model::find_model("generic21")),
                      {.imperfections = sim::Imperfections::none(),
                       .cradle = sim::Cradle::kAlways,
                       .cameras = true}};
  NumberDrawer drawer;
  camera::TwinCamera<NumberDrawer> camera{drawer, twin, 0};
};

}  // namespace verp::test
