#include "common/control/boot_check.hpp"
#include "common/control/step.hpp"

// Another namespace: only plain memory crosses.
extern "C" void planted_step(const void* params, void* state, const void* inputs, void* outputs);

extern "C" void planted_step(const void* params, void* state, const void* inputs, void* outputs) {
  verp::step(*static_cast<const verp::Params*>(params), *static_cast<verp::State*>(state),
             *static_cast<const verp::Inputs*>(inputs), *static_cast<verp::Outputs*>(outputs));
}

extern "C" int planted_boot_verdict();

extern "C" int planted_boot_verdict() {
  static verp::Params robot;
  static verp::State state;
  return static_cast<int>(verp::control::check_boot(nullptr, 0, robot, state).verdict);
}
