#pragma once
#include "common/control/step.hpp"
#include "common/model/counts.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::control::test {

using namespace verp::test;
using safety::Mode;

/// Servos reach every goal, so no knee feels a load, and soles report none. The IMU shakes about
/// rest, by less than tilts.
struct Loop {
  Loop() {
    command.request = Request::kRelax;
    inputs.flags = kImuFresh | kCommandFresh;
    inputs.fresh = ~0u;
    inputs.accel_count[2] = 8172;  // 1 g at 1.2 mm/s^2 a count
    for (int j = 0; j < kJointCount; ++j) {
      inputs.position_count[j] = model::count_of(kRobot.joint[j], kRobot.joint[j].sit_rad);
    }
  }
  void tick() {
    hear();
    step(kRobot, actions, state, inputs, outputs);
    follow();
  }
  void hear() { inputs.command = command; }
  void follow() {
    ++inputs.tick;
    if (noise) shake();
    command.sequence = static_cast<std::uint8_t>(command.sequence + 1);
    if (outputs.torque_enable == 0) return;
    for (int j = 0; j < kJointCount; ++j) inputs.position_count[j] = outputs.goal_count[j];
  }
  void shake() {
    for (int axis = 0; axis < 2; ++axis) {
      inputs.gyro_count[axis] = static_cast<std::int16_t>(inputs.gyro_count[axis] ^ 8);
      inputs.accel_count[axis] = static_cast<std::int16_t>(inputs.accel_count[axis] ^ 8);
    }
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  /// Ticks until `mode`, at most `most`; -1 if never.
  int until(Mode mode, int most) {
    for (int i = 0; i < most; ++i) {
      tick();
      if (is_in(mode)) return i;
    }
    return -1;
  }
  bool is_in(Mode mode) const { return outputs.mode == static_cast<std::uint8_t>(mode); }
  void walk(std::int16_t vx_tenth_mm_s) {
    command.request = Request::kWalk;
    command.vx_tenth_mm_s = vx_tenth_mm_s;
  }

  State state;
  Inputs inputs;
  Outputs outputs;
  Command command;
  action::Library actions;
  bool noise = true;
};

/// One for all tests: a small board has no RAM for more.
inline Loop& fresh_loop() {
  static Loop loop;
  return loop = Loop{};
}

/// kRobot to change, one for all tests.
inline Params& changed_robot() {
  static Params params;
  return params = kRobot;
}

inline void write_parameter(int id, float value, Inputs& inputs) {
  inputs.flags |= kParameterWrite;
  inputs.parameter_id = static_cast<std::uint16_t>(id);
  inputs.parameter_bits = std::bit_cast<std::uint32_t>(value);
}

/// Mostly plausible enough to get the robot up; `tick` is not touched.
inline void wild(Random& random, bool fully, const Outputs& last, Inputs& inputs) {
  std::uint32_t words[sizeof(Inputs) / 4];
  for (std::uint32_t& word : words) word = random.bits();
  const std::uint32_t tick = inputs.tick;
  __builtin_memcpy(static_cast<void*>(&inputs), words, sizeof(Inputs));
  inputs.tick = tick + 1;
  if (fully) return;
  inputs.fresh = ~0u;
  inputs.flags = kImuFresh | kFeetFresh | kSlowFresh | kCommandFresh;
  inputs.command.request = random.bits() % 1024 == 0 ? Request::kRelax : Request::kWalk;
  inputs.slow_error = 0;
  inputs.slow_temperature_c = 40;
  for (int i = 0; i < 3; ++i) {
    inputs.gyro_count[i] = static_cast<std::int16_t>(inputs.gyro_count[i] / 1024);
    inputs.accel_count[i] = static_cast<std::int16_t>(inputs.accel_count[i] / 16 + (i == 2) * 8172);
  }
  for (int j = 0; j < kJointCount; ++j) {  // further from its goal, it would not be believed
    const JointParams& joint = kRobot.joint[j];
    const bool held = last.torque_enable != 0;
    const float near_rad = held ? model::angle_of(joint, last.goal_count[j]) : joint.stand_rad;
    inputs.position_count[j] = model::count_of(joint, near_rad + random.between(-0.1F, 0.1F));
  }
  constexpr float kBad[] = {0.0F, -1.0F, 1e30F, -1e-40F};
  const int id = random.below(kTuningCount + 4);
  if (random.bits() % 4 == 0) {
    write_parameter(id, random.bits() % 2 == 0 ? quiet_nan() : kBad[random.below(4)], inputs);
  }
  if (random.bits() % 4 == 0) write_parameter(id, random.between(-1.0F, 2.0F), inputs);
}

}  // namespace verp::control::test
