#pragma once
#include <cstdint>

#include "common/control/state.hpp"
#include "common/model/image.hpp"

namespace verp::control {

/// An image's self_test_ticks must be equal.
inline constexpr std::uint32_t kSelfTestTicks = 256;

/// Last chain link after kSelfTestTicks of step() on generated inputs: stand, walk a few steps and
/// stop, servos at their goals, noise from IMU and feet. The boot check compares it with the
/// image's.
std::uint64_t self_test_digest(const Params& params, State& scratch);

}  // namespace verp::control
