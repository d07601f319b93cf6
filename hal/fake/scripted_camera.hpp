#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/camera.hpp"

/// A Camera that plays a script of pictures and faults. The script owns the bytes, as long as the
/// contract says.
namespace verp::hal {

class ScriptedCamera {
 public:
  /// A picture that was not read is lost. Sets sequence and lost.
  void show(const CameraFrame& frame) {
    frame_ = frame;
    frame_.sequence = made_++;
    fetched_ = false;
  }
  void fail(std::uint32_t reads) { failures_left_ = reads; }

  CameraStatus read(CameraFrame& frame) {
    if (failures_left_ > 0) {
      --failures_left_;
      ++faults_;
      return CameraStatus::kFault;
    }
    if (fetched_) return CameraStatus::kStale;
    fetched_ = true;
    frame_.lost = frame_.sequence - next_;
    next_ = frame_.sequence + 1;
    frame = frame_;
    return CameraStatus::kFresh;
  }
  std::uint32_t faults() const { return faults_; }

 private:
  CameraFrame frame_;
  std::uint32_t made_ = 0, next_ = 0;
  std::uint32_t failures_left_ = 0;
  std::uint32_t faults_ = 0;
  bool fetched_ = true;
};

static_assert(Camera<ScriptedCamera>);

}  // namespace verp::hal
