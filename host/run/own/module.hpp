#pragma once
#include <cstdint>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp::own {

/// Exported as `verp_own_module`; no exception crosses these C calls.
struct Module {
  /// sizeof each struct as compiled into the module
  std::uint32_t params_bytes, state_bytes, inputs_bytes, outputs_bytes;
  /// A controller in its initial state; null: out of memory.
  void* (*make)();
  void (*unmake)(void* controller);
  /// Returns the first joint with a refused goal, and that goal; -1: none.
  int (*decide)(void* controller, const Params* params, State* state, const Inputs* inputs,
                Outputs* outputs, std::int32_t* refused_count);
};

}  // namespace verp::own
