#pragma once
#include "common/action/library.hpp"
#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp {

/// One control tick of the whole robot. Total: any input gives a safe output and, where needed, a
/// latched fault; it never fails, blocks, allocates or logs. Same bits on every core and compiler
/// under the floating-point contract.
void step(const Params& params, const action::Library& actions, State& state, const Inputs& inputs,
          Outputs& outputs) noexcept;
inline void step(const Params& params, State& state, const Inputs& inputs,
                 Outputs& outputs) noexcept {
  step(params, action::Library{}, state, inputs, outputs);
}

}  // namespace verp
