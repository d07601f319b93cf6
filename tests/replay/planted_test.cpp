#include <gtest/gtest.h>

#include "common/control/boot_check.hpp"
#include "common/control/step.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/trace/record/replay.hpp"
#include "tests/replay/long_trace.hpp"

extern "C" void planted_step(const void* params, void* state, const void* inputs, void* outputs);
extern "C" int planted_boot_verdict();

namespace verp::replay {
namespace {

record::Trace recording() {
  const Params robot = model::make_params(model::load_robot(model::find_model("generic21")));
  Segment segment = make_long_trace(robot, 4'000).front();
  record::Trace trace;
  trace.params = segment.params;
  trace.ticks = std::move(segment.ticks);
  return trace;
}

void planted(const Params& params, State& state, const Inputs& inputs, Outputs& outputs) {
  planted_step(&params, &state, &inputs, &outputs);
}

TEST(PlantedUlp, OfOneGaitConstantIsCaughtWithTickStageAndField) {
  const record::Trace trace = recording();
  const auto result = record::replay(trace, nullptr, planted);
  EXPECT_NE(result.recorded_digest, result.replayed_digest);
  ASSERT_TRUE(result.divergence);
  const record::Divergence& found = *result.divergence;
  EXPECT_EQ(found.stage, "plan");
  ASSERT_FALSE(found.fields.empty());
  EXPECT_EQ(found.fields[0].path.rfind("gait.", 0), 0u) << found.fields[0].path;
  EXPECT_EQ(found.fields_tick, found.tick) << "the field at the very tick";
  const std::string line = record::text(found, trace.params, "recorded", "planted");
  EXPECT_NE(line.find("tick " + std::to_string(found.tick) + " ("), std::string::npos) << line;
  EXPECT_NE(line.find("stage plan"), std::string::npos) << line;
  EXPECT_NE(line.find("field gait."), std::string::npos) << line;
  std::printf("%s\n", line.c_str());
}

// Until a step is planned, both cores give the same bits.
TEST(PlantedUlp, DoesNotShowBeforeTheFirstStep) {
  const record::Trace trace = recording();
  const auto result = record::replay(trace, nullptr, planted);
  ASSERT_TRUE(result.divergence);
  State state;
  Outputs outputs;
  for (std::size_t i = 0; i < result.divergence->index; ++i) {
    step(trace.params, state, trace.ticks[i].inputs, outputs);
  }
  EXPECT_EQ(state.gait.queued, 0) << "nothing planned before";
  step(trace.params, state, trace.ticks[result.divergence->index].inputs, outputs);
  EXPECT_GT(state.gait.queued, 0);
}

// Such code, from a bad flash cell or a wrong compiler, gets no torque.
TEST(PlantedUlp, IsFoundByTheBootCheckBeforeAnyRobotIsLookedAt) {
  EXPECT_EQ(planted_boot_verdict(), static_cast<int>(control::BootVerdict::kCode));
  Params robot;
  State state;
  EXPECT_EQ(control::check_boot(nullptr, 0, robot, state).verdict, control::BootVerdict::kImage);
}

TEST(PlantedUlp, RecordingReplaysWithItsOwnCore) {
  EXPECT_FALSE(record::replay(recording()).divergence);
}

}  // namespace
}  // namespace verp::replay
