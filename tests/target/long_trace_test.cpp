#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "host/boards/board/replay_on_target.hpp"
#include "tests/replay/long_trace.hpp"
#include "tests/target/twin_run.hpp"

// A firmware build's ctest sets VERP_TEST_BOARD and VERP_TEST_TICKS.
namespace verp::board {
namespace {

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

void expect_same(const replay::Segment& segment, const TargetReplay& there) {
  ASSERT_EQ(there.digests.size(), segment.ticks.size());
  for (std::size_t i = 0; i < segment.ticks.size(); ++i) {
    const TickDigest& recorded = segment.ticks[i].digest;
    for (int stage = 0; stage < kStages; ++stage) {
      ASSERT_EQ(there.digests[i].stage[stage], recorded.stage[stage])
          << segment.name << ": first divergence: tick " << i << ", stage " << kStageNames[stage];
    }
    ASSERT_EQ(there.digests[i].chain, recorded.chain) << segment.name << ": tick " << i;
  }
}

TEST(LongTrace, GivesTheSameDigestsInTheBoard) {
  const std::string board = setting("VERP_TEST_BOARD");
  const std::string ticks = setting("VERP_TEST_TICKS");
  ASSERT_FALSE(board.empty() || ticks.empty()) << "set VERP_TEST_BOARD and VERP_TEST_TICKS";
  const auto length = static_cast<std::uint32_t>(std::stoul(ticks));
  const auto trace = replay::make_long_trace(test::load_robot("generic21").params, length);
  for (const replay::Segment& segment : trace) {
    std::vector<Inputs> inputs;
    for (const TickRecord& tick : segment.ticks) inputs.push_back(tick.inputs);
    expect_same(segment, replay_on(board, segment.params, inputs, {.limit_s = 3600}));
  }
  std::printf("%-10s %6u ticks, digest %016llx\n", board.c_str(), length,
              static_cast<unsigned long long>(replay::digest_of(trace)));
}

}  // namespace
}  // namespace verp::board
