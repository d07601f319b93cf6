#pragma once
#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp {

/// One control tick, the whole robot. Total: any input gives a safe output and, where needed, a
/// latched fault; it never fails, blocks, allocates or logs. Same bits on every core and compiler
/// under the floating-point contract.
void step(const Params& params, State& state, const Inputs& inputs, Outputs& outputs) noexcept;

}  // namespace verp
