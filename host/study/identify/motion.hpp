#pragma once
#include <cstdint>

#include "host/author/action/document.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::identify {

struct MotionOptions {
  double length_s = 60;
  std::uint64_t seed = 1;
};

/// An action that tells much of a robot's servos while its trunk hangs in a stand: all joints at
/// once, far and near, slow and as fast as they may, and at rest between. No link meets another.
action::Document motion_of(const model::Entity& entity, const MotionOptions& options = {});

}  // namespace verp::identify
