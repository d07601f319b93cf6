#pragma once
#include "common/control/state.hpp"

namespace verp {

/// Digests of all stages of a finished tick, each over its own state and output, chained to those
/// before. One function that is never inlined, so that its cost can be counted apart.
[[gnu::noinline]] void digest_state(const Inputs& inputs, const Outputs& outputs, State& state);

}  // namespace verp
