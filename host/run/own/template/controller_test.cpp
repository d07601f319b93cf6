// Tests the controller without a robot: build/pc/controller_test, or ctest --test-dir build/pc.
#include <cstdio>

#include "common/control/built_in_robot.hpp"
#include "controller.hpp"

int main() {
  verp::Params params;
  verp::control::make_built_in_robot(params);  // a pair of legs, without arms
  verp::State state;
  verp::Inputs in;
  verp::Outputs out;
  Controller controller;
  for (in.tick = 0; in.tick < 100; ++in.tick) {
    verp::step(params, state, in, out);
    controller(params, state, in, out);
  }
  if (out.torque_enable != 0) return std::puts("nobody asked it to stand, and it has torque"), 1;
  if (controller.up != 0) return std::puts("its arm is up, and it does not stand"), 1;
  std::puts("good");
  return 0;
}
