#pragma once
#include "common/control/state.hpp"

namespace verp {

/// Digests all stages of a finished tick, each over its own state and output, and extends the
/// chain. Never inlined, so that its cost can be measured.
[[gnu::noinline]] void digest_state(const Inputs& inputs, const Outputs& outputs, State& state);

}  // namespace verp
