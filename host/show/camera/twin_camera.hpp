#pragma once
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "hal/contract/camera.hpp"
#include "host/show/camera/rig.hpp"
#include "host/twin/sim/robot.hpp"

namespace verp::camera {

/// A twin's camera as hal/contract/camera.hpp. It takes all exposures: other cameras get none.
/// Depth or labels alone give no pictures. Drawer: a Rig or a test's; if its take() never waits,
/// read() does not.
template <class Drawer = Rig>
class TwinCamera {
 public:
  /// The twin needs TwinOptions::cameras.
  TwinCamera(Drawer& drawer, sim::TwinRobot& twin, std::uint32_t camera)
      : drawer_(drawer), twin_(twin), camera_(camera) {}

  hal::CameraStatus read(hal::CameraFrame& frame) {
    bool fresh = false;
    try {
      expose();
      for (auto done = drawer_.take(); !done.empty(); done = drawer_.take()) {
        for (Picture& picture : done) fresh = keep(std::move(picture)) || fresh;
      }
    } catch (const CameraError&) {
      ++faults_;
      return hal::CameraStatus::kFault;
    }
    if (!fresh) return hal::CameraStatus::kStale;
    tell(frame);
    return hal::CameraStatus::kFresh;
  }
  std::uint32_t faults() const { return faults_; }

 private:
  void expose() {
    for (sim::Exposure& each : twin_.take_exposures()) {
      for (const std::size_t looked : each.cameras) {
        if (looked != camera_) continue;
        drawer_.expose({.time_us = each.time_us,
                        .cameras = {camera_},
                        .link_world = std::move(each.link_world),
                        .body_world = std::move(each.body_world),
                        .robot = static_cast<std::uint32_t>(each.robot)});
        break;
      }
    }
  }
  bool keep(Picture picture) {
    if (picture.camera != camera_ || picture.encoding != "png") return false;
    picture_ = std::move(picture);
    return true;
  }
  /// Exposures are at whole periods of simulated time, which give the sequence number.
  void tell(hal::CameraFrame& frame) {
    const double rate_hz = twin_.entity().cameras[camera_].rate_hz;
    const auto period = std::llround(1e-6 * static_cast<double>(picture_.time_us) * rate_hz);
    frame.sequence = static_cast<std::uint32_t>(period) - 1;
    frame.lost = frame.sequence - next_;
    next_ = frame.sequence + 1;
    frame.width_px = picture_.width;
    frame.height_px = picture_.height;
    frame.format = hal::PixelFormat::kPng;
    frame.stride_bytes = 0;
    frame.time_us = picture_.time_us;
    frame.data = reinterpret_cast<const std::uint8_t*>(picture_.data.data());
    frame.size_bytes = picture_.data.size();
  }

  Drawer& drawer_;
  sim::TwinRobot& twin_;
  const std::uint32_t camera_;
  Picture picture_;
  std::uint32_t next_ = 0, faults_ = 0;
};

static_assert(hal::Camera<TwinCamera<>>);

}  // namespace verp::camera
