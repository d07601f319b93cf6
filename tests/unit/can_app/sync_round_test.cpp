#include <gtest/gtest.h>

#include "firmware/app/sync_round.hpp"
#include "tests/unit/can_app/can_loop.hpp"

namespace verp::app {
namespace {

using test::kAll;
using Loop = test::CanLoop;

constexpr std::uint8_t kGroups = 3;
constexpr int kInGroup = 4;

/// Four nodes each; all answered in the previous tick.
struct Round {
  AnswerWatch answers;
  SyncRound round{kGroups};

  Round() {
    for (int node = 0; node < kGroups * kInGroup; ++node) {
      answers.plan(node, static_cast<std::uint8_t>(node / kInGroup + 1));
    }
    begin();
    for (std::uint8_t group = 1; group <= kGroups; ++group) answer(group, group);
    begin();
  }
  void begin() {
    answers.begin();
    round.begin();
  }
  void answer(std::uint8_t group, std::uint8_t window, int nodes = kInGroup) {
    for (int i = 0; i < nodes; ++i) answers.take((group - 1) * kInGroup + i, window);
  }
  int after(std::uint8_t window, bool quiet = true) { return round.after(window, answers, quiet); }
};

TEST(SyncRound, SendsEachInTurnAsLongAsAllIsWell) {
  Round round;
  for (std::uint8_t window = 1; window <= kGroups; ++window) {
    round.answer(window, window);
    EXPECT_EQ(round.after(window, false), window + 1);
  }
}

TEST(SyncRound, SendsOneFewerWhereAGroupCameBeforeItsTurn) {
  Round round;
  round.answer(2, 1);
  EXPECT_EQ(round.after(1), 3);
  round.answer(3, 3);
  EXPECT_EQ(round.after(3), 4);
  Round twice;
  twice.answer(3, 1);
  EXPECT_EQ(twice.after(1), 2) << "or one behind, which costs less";
}

TEST(SyncRound, SendsOneMoreWhereNobodyAnswers) {
  Round round;
  round.answer(1, 1);
  EXPECT_EQ(round.after(1), 2);
  EXPECT_EQ(round.after(2), 2);
  EXPECT_EQ(round.after(2), 3) << "once in a tick";
  round.begin();
  round.answer(1, 1);
  EXPECT_EQ(round.after(2), 3) << "who was silent before is silent";
}

// All groups answer one SYNC late from then on.
TEST(SyncRound, SendsOneMoreWhereAGroupComesAfterItsTurn) {
  Round round;
  EXPECT_EQ(round.after(1), 2) << "SYNC 1 begins a tick: never twice";
  round.answer(1, 2);
  EXPECT_EQ(round.after(2), 2);
  round.answer(2, 2);
  EXPECT_EQ(round.after(2), 3);
}

TEST(SyncRound, DoesNothingOnACrowdedBus) {
  Round round;
  EXPECT_EQ(round.after(1, false), 2);
  round.answer(1, 2);
  EXPECT_EQ(round.after(2, false), 3);
  Round ahead;
  ahead.answer(2, 1);
  EXPECT_EQ(ahead.after(1, false), 2);
}

TEST(SyncRound, ASingleNodeShowsNothing) {
  Round round;
  round.answer(1, 1, kInGroup - 1);
  round.answer(2, 1, 1);
  EXPECT_EQ(round.after(1), 2);
  round.answer(2, 2);
  EXPECT_EQ(round.after(2), 3);
  round.answer(3, 3, kInGroup - 1);
  EXPECT_EQ(round.after(3), 4);
}

TEST(SyncRound, GroupsAreWaitedForInTheirPlacesAgain) {
  Round round;
  for (int tick = 0; tick < 3; ++tick) {
    round.begin();
    round.answer(2, 1);
  }
  ASSERT_NE(round.answers.astray(), 0u);
  EXPECT_EQ(round.after(1), 3);
  EXPECT_EQ(round.answers.astray(), 0u);
}

int times_on(Loop& loop) {
  int times = 0;
  for (test::DriveNode& each : loop.bench.drives) {
    times += each.device.objects().tpdos[0].times_on();
  }
  return times;
}

// As after an error in the last bit but one of the frame.
TEST(SyncRound, AfterASyncTooManyAllNodesAreBackInTwoTicks) {
  for (const int extra : {1, 2}) {
    Loop& loop = test::new_can_loop();
    loop.enable();
    loop.run(20);
    const int before = times_on(loop);
    loop.bench.of_other = canopen::sync_frame(9);
    loop.bench.others = extra;
    loop.run(3);
    for (int i = 0; i < 20; ++i) {
      loop.tick();
      EXPECT_EQ(loop.inputs.fresh, kAll) << i;
      EXPECT_EQ(loop.inputs.flags & (kImuFresh | kFeetFresh), kImuFresh | kFeetFresh) << i;
    }
    EXPECT_EQ(times_on(loop), before) << "nobody was brought back by itself";
  }
}

TEST(SyncRound, AfterLostSyncsAllNodesAreBack) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  loop.run(20);
  const int before = times_on(loop);
  loop.bench.deaf_to = canopen::kSyncId;
  loop.tick();
  loop.bench.deaf_to = 0;
  loop.run(3);
  for (int i = 0; i < 20; ++i) {
    loop.tick();
    EXPECT_EQ(loop.inputs.fresh, kAll) << i;
  }
  EXPECT_EQ(times_on(loop), before);
}

}  // namespace
}  // namespace verp::app
