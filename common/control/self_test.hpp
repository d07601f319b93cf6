#pragma once
#include <cstdint>

#include "common/control/state.hpp"
#include "common/model/image.hpp"

namespace verp::control {

/// Ticks of the self-test; an image's self_test_ticks must be equal.
inline constexpr std::uint32_t kSelfTestTicks = 256;

/// Last chain link after kSelfTestTicks of step() on generated inputs: servos follow their goals,
/// the operator asks to stand, walk a few steps and stop, IMU and feet report noise around rest.
/// The boot check compares it with the image's: same core, same compiler contract, working memory.
std::uint64_t self_test_digest(const Params& params, State& scratch);

}  // namespace verp::control
