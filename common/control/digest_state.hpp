#pragma once
#include "common/control/state.hpp"

namespace verp {

/// Digests each stage's state and output and extends the chain. Not inlined, to measure its cost.
[[gnu::noinline]] void digest_state(const Inputs& inputs, const Outputs& outputs, State& state);

}  // namespace verp
