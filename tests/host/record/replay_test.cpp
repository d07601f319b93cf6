#include "host/trace/record/replay.hpp"

#include <bit>

#include "host/trace/record/trace_parts.hpp"
#include "tests/host/record/sample.hpp"

namespace verp::record::test {
namespace {

/// From tick `from` on one bit of State flips per tick.
StepFunction planted(std::uint32_t from, std::size_t offset) {
  return [=](const Params& params, State& state, const Inputs& inputs, Outputs& outputs) {
    step(params, state, inputs, outputs);
    if (inputs.tick < from) return;
    reinterpret_cast<unsigned char*>(&state)[offset] ^= 1;
    state.digest.stage[3] ^= 1;
  };
}

TEST(Replay, OfAnUnchangedTraceIsEqual) {
  const Trace trace = sample_run(400);
  const ReplayResult result = replay(trace);
  EXPECT_FALSE(result.divergence);
  EXPECT_EQ(result.ticks, 400u);
  EXPECT_EQ(result.recorded_digest, result.replayed_digest);
}

TEST(Replay, OfAnEmptyTraceIsEqual) {
  EXPECT_FALSE(replay(sample_run(0)).divergence);
}

TEST(Replay, ChangedInputIsCaughtAtItsTickInAdmit) {
  Trace trace = sample_run(400);
  trace.ticks[217].inputs.gyro_count[1] = 1;
  const ReplayResult result = replay(trace);
  ASSERT_TRUE(result.divergence);
  EXPECT_EQ(result.divergence->tick, 217u);
  EXPECT_EQ(result.divergence->stage, "admit");
  EXPECT_NE(result.recorded_digest, result.replayed_digest);
}

TEST(Replay, ChangedCoreIsNamedByTickStageAndField) {
  const Trace trace = sample_run(400);
  const std::size_t offset =
      offsetof(State, tuning) + offsetof(Tuning, gait) + offsetof(GaitTuning, lift_m);
  const ReplayResult result = replay(trace, nullptr, planted(130, offset));
  ASSERT_TRUE(result.divergence);
  EXPECT_EQ(result.divergence->tick, 130u);
  EXPECT_EQ(result.divergence->stage, kStageNames[3]);
  ASSERT_FALSE(result.divergence->fields.empty());
  EXPECT_EQ(result.divergence->fields[0].path, "tuning.gait.lift_m");
  EXPECT_EQ(result.divergence->fields_tick, 130u);
  const std::string line = text(*result.divergence, trace.params, "recorded", "replayed");
  EXPECT_NE(line.find("tick 130 (1.300 s): stage balance"), std::string::npos) << line;
  EXPECT_NE(line.find("field tuning.gait.lift_m: recorded"), std::string::npos) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST_F(TraceFolder, ReplaysInTheRoomOfAChunkAsInMemory) {
  const std::size_t kLift =
      offsetof(State, tuning) + offsetof(Tuning, gait) + offsetof(GaitTuning, lift_m);
  const fs::path file = folder_ / "run.mcap";
  write_run(file, 300);
  TraceFile streamed(file, Read::kStrict);
  for (const StepFunction& core : {StepFunction(), planted(130, kLift)}) {
    const ReplayResult a = replay(streamed, core), b = replay(read_trace(file), nullptr, core);
    EXPECT_EQ(a.ticks, 300u);
    EXPECT_EQ(a.recorded_digest, b.recorded_digest);
    EXPECT_EQ(a.replayed_digest, b.replayed_digest);
    ASSERT_EQ(a.divergence.has_value(), static_cast<bool>(core));
    if (!core) continue;
    EXPECT_EQ(text(*a.divergence, sample_params(), "a", "b"),
              text(*b.divergence, sample_params(), "a", "b"));
  }
}

TEST(Replay, ForeignTraceIsNamedFromTheNextKeptState) {
  Trace trace = sample_run(400);
  for (std::size_t i = 130; i < 400; ++i) trace.ticks[i].digest.stage[2] ^= 1;
  trace.keyframes[2].state.tuning.gait.cycle_s =
      std::bit_cast<float>(std::bit_cast<std::uint32_t>(trace.params.tuning.gait.cycle_s) + 1u);
  const ReplayResult result = replay(trace);
  ASSERT_TRUE(result.divergence);
  EXPECT_EQ(result.divergence->tick, 130u);
  EXPECT_EQ(result.divergence->stage, "plan");
  ASSERT_EQ(result.divergence->fields.size(), 1u);
  EXPECT_EQ(result.divergence->fields[0].path, "tuning.gait.cycle_s");
  EXPECT_EQ(result.divergence->fields_tick, 250u);
}

TEST(Diff, EqualTracesHaveNone) {
  EXPECT_FALSE(diff(sample_run(200), sample_run(200)));
}

TEST(Diff, InputFieldIsNamedWithItsJoint) {
  const Trace left = sample_run(200);
  Trace right = left;
  right.ticks[42].inputs.position_count[1] += 1;
  const auto found = diff(left, right);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->tick, 42u);
  EXPECT_EQ(found->stage, "inputs");
  ASSERT_EQ(found->fields.size(), 1u);
  EXPECT_EQ(found->fields[0].path, "position_count[1]");
  EXPECT_NE(
      text(*found, left.params, "A", "B").find("position_count[1] (l_knee): A 2006 (0x000007d6)"),
      std::string::npos);
}

TEST(Diff, StageIsNamedWhenInputsAreEqual) {
  const Trace left = sample_run(200);
  Trace right = left;
  right.ticks[60].digest.stage[5] ^= 8;
  const auto found = diff(left, right);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->tick, 60u);
  EXPECT_EQ(found->stage, "limit");
}

TEST(Diff, RobotsAreComparedFirst) {
  const Trace left = sample_run(10);
  Trace right = left;
  right.params.tuning.gait.lift_m = 0.007f;
  const auto found = diff(left, right);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->stage, "params");
  EXPECT_EQ(found->fields[0].path, "tuning.gait.lift_m");
}

TEST(Diff, PrefixIsNamedByLength) {
  const auto found = diff(sample_run(200), sample_run(150));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->stage, "length");
  EXPECT_EQ(found->tick, 150u);
}

}  // namespace
}  // namespace verp::record::test
