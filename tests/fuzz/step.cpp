// The controller: any Inputs, tick after tick, to a robot whose Params pass the checks of an image.
// The State is reached through ticks only. libFuzzer's -timeout bounds the instructions.
#include "common/control/step.hpp"

#include <vector>

#include "common/model/coupling.hpp"
#include "common/model/image.hpp"
#include "common/model/numbers.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/action/shelf.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::fuzz {
namespace {

struct Run {
  Params params;
  Inputs inputs;
  State state = {};
  Outputs outputs = {};
};

Run at_rest(const Params& params) {
  Run run{params, {}};
  run.inputs.fresh = ~0U;
  run.inputs.flags = kImuFresh | kFeetFresh | kCommandFresh;
  run.inputs.accel_count[2] = 8172;  // 1 g of the test robot's IMU
  for (int j = 0; j < params.joint_count; ++j)
    run.inputs.position_count[j] = model::count_of(params.joint[j], params.joint[j].sit_rad);
  return run;
}

/// The next tick, after what the last one asked of the servos.
void change(Inputs& inputs, std::uint8_t how, Bytes& bytes) {
  ++inputs.tick;
  inputs.accel_count[2] ^= 1;  // else it counts as frozen
  inputs.flags &= static_cast<std::uint16_t>(~kParameterWrite);
  if ((how & 1) != 0) {
    inputs.command.request = static_cast<Request>(bytes.byte() % 5);
    inputs.command.vx_tenth_mm_s = static_cast<std::int16_t>(bytes.word());
    inputs.command.wz_mrad_s = static_cast<std::int16_t>(bytes.word());
  }
  if ((how & 2) != 0) patch(inputs, 8, bytes);
  if ((how & 4) != 0) {
    inputs.flags |= kParameterWrite;
    inputs.parameter_id = bytes.byte() % (kTuningCount + 1);
    inputs.parameter_bits = bytes.take<std::uint32_t>();
  }
  if ((how & 8) != 0) inputs.action = bytes.byte() % 4;
  if ((how & 16) != 0) inputs.flags |= kImuFresh | kFeetFresh | kCommandFresh;
  if ((how & 16) != 0) inputs.fresh = ~0U;
}

void follow(const Params& params, const Outputs& outputs, Inputs& inputs) {
  for (int j = 0; j < params.joint_count; ++j) {
    if ((outputs.torque_enable >> j & 1U) != 0) inputs.position_count[j] = outputs.goal_count[j];
  }
}

void judge(const Params& params, const State& state, const Outputs& outputs) {
  require(test::struct_is_finite(state), "the State is finite");
  require(outputs.mode < safety::kModes, "the mode is one of the table");
  const bool torque = safety::has_torque(static_cast<safety::Mode>(outputs.mode));
  require(torque || outputs.torque_enable == 0, "a limp mode has no torque");
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[model::driver_of(params, j)];
    const std::int32_t a = model::count_of(joint, joint.lower_rad);
    const std::int32_t b = model::count_of(joint, joint.upper_rad);
    require(outputs.goal_count[j] >= (a < b ? a : b) && outputs.goal_count[j] <= (a < b ? b : a),
            "a goal is inside its joint's limits");
  }
}

void tick(Run& run, bool follows) {
  static action::test::Shelf& shelf = *new action::test::Shelf;
  shelf.goal(1, test::kLeftArm, 0.5F);
  step(run.params, shelf.library(), run.state, run.inputs, run.outputs);
  judge(run.params, run.state, run.outputs);
  if (follows) follow(run.params, run.outputs, run.inputs);
}

/// A robot that stands and knows its gyro's bias: it takes seconds, so each process does it once.
const Run& standing(std::size_t which) {
  static const std::vector<Run> runs = [] {
    std::vector<Run> made = {at_rest(test::kRobot), at_rest(test::make_offset_robot()),
                             at_rest(test::make_hyperextended_robot()),
                             at_rest(test::make_massless_legs_robot())};
    for (Run& run : made) {
      for (int ticks = 0; ticks < 450; ++ticks) {
        run.inputs.command.request = Request::kStand;
        tick(run, true);
        Bytes nothing(nullptr, 0);
        change(run.inputs, 0, nothing);
      }
    }
    return made;
  }();
  return runs[which];
}

/// One of those, or at rest with other Params that an image's checks accept.
Run begun(Bytes& bytes) {
  const std::uint8_t which = bytes.byte();
  const Run& sound = standing(which % 4);
  if (which / 4 % 2 == 0) return sound;
  Params params = sound.params;
  params.tuning.safety.rise_s = 0.2F;  // few ticks to the stand
  params.period_us = 20'000;
  const Params quick = params;
  patch(params, 4, bytes);
  FieldName bad;
  return at_rest(is_well_formed(params) && numbers_fit(params, bad) ? params : quick);
}

}  // namespace
}  // namespace verp::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  fuzz::Run run = fuzz::begun(bytes);
  for (int ticks = 0; bytes.left() > 0 && ticks < 320;) {
    const std::uint8_t how = bytes.byte(), length = bytes.byte();
    fuzz::change(run.inputs, how, bytes);
    for (int i = 0; i <= length; ++i, ++ticks) {
      fuzz::tick(run, (how & 32) != 0);
      if (i < length) fuzz::change(run.inputs, 0, bytes);
    }
  }
  return 0;
}
