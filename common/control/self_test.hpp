#pragma once
#include <cstdint>

#include "common/control/state.hpp"
#include "common/model/image.hpp"

namespace verp::control {

/// Length of the self-test; what an image's self_test_ticks says.
inline constexpr std::uint32_t kSelfTestTicks = 256;

/// The last link of the digest chain after kSelfTestTicks ticks of step() on made-up inputs: the
/// servos follow their goals, the operator asks to stand, to walk a few steps and to stop, and the
/// IMU and the feet report noise around rest. Boots compare it with the image's: same core, same
/// compiler contract, working memory.
std::uint64_t self_test_digest(const Params& params, State& scratch);

}  // namespace verp::control
