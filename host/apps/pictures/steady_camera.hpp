#pragma once
#include <optional>

#include "host/show/scene/camera.hpp"

namespace verp::pictures {

/// Follows the robot without its sway.
class SteadyCamera {
 public:
  scene::Camera follow(scene::Camera wanted) {
    constexpr double kShare = 0.06;  // of the way, per picture
    if (last_) {
      wanted.eye_m = last_->eye_m + kShare * (wanted.eye_m - last_->eye_m);
      wanted.target_m = last_->target_m + kShare * (wanted.target_m - last_->target_m);
    }
    last_ = wanted;
    return wanted;
  }

 private:
  std::optional<scene::Camera> last_;
};

}  // namespace verp::pictures
