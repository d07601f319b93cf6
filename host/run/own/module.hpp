#pragma once
#include <cstdint>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp::own {

/// What a controller.so hands out, as `verp_own_module`. Plain C calls: nothing is thrown across.
struct Module {
  /// Of the structs it was compiled with.
  std::uint32_t params_bytes, state_bytes, inputs_bytes, outputs_bytes;
  /// A controller that remembers nothing yet; null: no memory.
  void* (*make)();
  void (*unmake)(void* controller);
  /// One tick. The first joint whose goal was refused, and that goal; -1: none.
  int (*decide)(void* controller, const Params* params, State* state, const Inputs* inputs,
                Outputs* outputs, std::int32_t* refused_count);
};

}  // namespace verp::own
