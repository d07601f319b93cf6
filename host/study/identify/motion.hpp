#pragma once
#include <cstdint>

#include "host/author/action/document.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::identify {

struct MotionOptions {
  double length_s = 60;
  std::uint64_t seed = 1;
};

/// Excites all servos while the trunk hangs in a stand. Joints move together, far and near, slowly
/// and at their limits, and rest in between. No links meet.
action::Document motion_of(const model::Entity& entity, const MotionOptions& options = {});

}  // namespace verp::identify
