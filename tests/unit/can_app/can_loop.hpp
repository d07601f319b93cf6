#pragma once
#include <gtest/gtest.h>

#include <new>

#include "firmware/app/canopen_servos.hpp"
#include "tests/unit/can_app/can_bench.hpp"

namespace verp::test {

inline constexpr std::uint32_t kAll = (1u << kBenchJoints) - 1;

/// No core: the test sets the outputs.
struct CanLoop {
  CanBench bench;
  app::CanopenServos servos{bench.params, bench};
  Inputs inputs;
  Outputs outputs;

  void tick() {
    inputs.fresh = 0;
    inputs.flags = 0;
    servos.read_positions(inputs);
    servos.read_sensors(inputs, true);
    servos.send(outputs);
    ++inputs.tick;
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) tick();
  }
  void up() { EXPECT_TRUE(servos.bring_up().status == app::BringUpStatus::kReady); }
  void enable() {
    up();
    for (int j = 0; j < kBenchJoints; ++j) outputs.goal_count[j] = 200 + j;
    outputs.torque_enable = kAll;
    run(12);
  }
  bool all_in(canopen::cia402::State state) const {
    for (const test::DriveNode& drive : bench.drives) {
      if (drive.state() != state) return false;
    }
    return true;
  }
};

/// A chip's stack is too small for the loop.
inline CanLoop& new_can_loop() {
  alignas(CanLoop) static unsigned char room[sizeof(CanLoop)];
  return *new (room) CanLoop();
}

}  // namespace verp::test
