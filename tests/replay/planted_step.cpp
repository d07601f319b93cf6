#include "common/control/step.hpp"

// Compiled with another name for the namespace: nothing but plain memory crosses.
extern "C" void planted_step(const void* params, void* state, const void* inputs, void* outputs);

extern "C" void planted_step(const void* params, void* state, const void* inputs, void* outputs) {
  verp::step(*static_cast<const verp::Params*>(params), *static_cast<verp::State*>(state),
             *static_cast<const verp::Inputs*>(inputs), *static_cast<verp::Outputs*>(outputs));
}
