#include <gtest/gtest.h>

#include "firmware/app/answer_watch.hpp"
#include "firmware/app/sensed_counts.hpp"
#include "tests/unit/can_app/can_loop.hpp"

namespace verp::app {
namespace {

using test::kAll;
using test::kBenchJoints;
using Loop = test::CanLoop;

constexpr int kNode = 2;

AnswerWatch watch_of_group(std::uint8_t group) {
  AnswerWatch watch;
  watch.plan(kNode, group);
  return watch;
}

TEST(AnswerWatch, ALateAnswerOfTheTickBeforeDoesNotCountWhereverItComes) {
  for (const std::uint8_t comes_in : {std::uint8_t{1}, std::uint8_t{3}, std::uint8_t{4}}) {
    AnswerWatch watch = watch_of_group(2);
    watch.begin();
    EXPECT_TRUE(watch.take(kNode, 2) == Answer::kFresh);
    watch.begin();
    watch.begin();
    EXPECT_TRUE(watch.take(kNode, comes_in) == Answer::kOld) << static_cast<int>(comes_in);
    EXPECT_TRUE(watch.take(kNode, 2) == Answer::kFresh) << "the one of this tick";
  }
}

// Else the answer would be read a window later and seem to move again.
TEST(AnswerWatch, IsAlsoWaitedForWhereItCameInThePlaceOfItsOwn) {
  AnswerWatch watch = watch_of_group(5);
  watch.begin();
  EXPECT_TRUE(watch.take(kNode, 5) == Answer::kFresh);
  watch.begin();
  EXPECT_EQ(watch.due(1, 0), 0u);
  watch.begin();
  EXPECT_TRUE(watch.take(kNode, 1) == Answer::kOld);
  EXPECT_EQ(watch.due(1, 0), 0u) << "it has answered";
  watch.begin();
  EXPECT_EQ(watch.due(1, 0), node_bit(kNode));
  EXPECT_EQ(watch.due(5, 0), node_bit(kNode)) << "here, too, until it is known";
  EXPECT_EQ(watch.due(2, 0), 0u);
  watch.begin();
  EXPECT_EQ(watch.due(1, 0), 0u) << "once only: nothing came there";
}

TEST(AnswerWatch, OfTwoAnswersInATickNobodyKnowsWhichIsOld) {
  AnswerWatch watch = watch_of_group(2);
  watch.begin();
  EXPECT_TRUE(watch.take(kNode, 2) == Answer::kFresh);
  EXPECT_TRUE(watch.take(kNode, 2) == Answer::kAgain);
  watch.spoil(kNode);
  EXPECT_TRUE(watch.take(kNode, 2) == Answer::kOld) << "nor of three";
  watch.begin();
  EXPECT_TRUE(watch.take(kNode, 2) == Answer::kFresh) << "for one tick";
}

// A gateway delays everything by a tick.
TEST(AnswerWatch, AfterSilenceNothingCountsUntilTheBusIsPrompt) {
  AnswerWatch watch = watch_of_group(2);
  for (int tick = 0; tick < 20; ++tick) {
    watch.prompt();
    watch.begin();
    EXPECT_TRUE(watch.take(kNode, 2) == Answer::kFresh);
  }
  watch.begin();
  for (int tick = 0; tick < 10; ++tick) {
    watch.begin();
    EXPECT_TRUE(watch.take(kNode, 2) == Answer::kOld) << tick;
  }
  watch.begin();
  watch.prompt();
  EXPECT_TRUE(watch.take(kNode, 2) == Answer::kFresh);
}

// A drive that misses the bus for one tick answers a tick late: in its own place, but old.
TEST(AnswerWatch, WhoOwesAnAnswerDoesNotCountUntilTheBusIsPrompt) {
  constexpr int kOther = 3;
  AnswerWatch watch = watch_of_group(2);
  watch.plan(kOther, 2);
  for (int tick = 0; tick < 20; ++tick) {
    watch.begin();
    watch.prompt();
    EXPECT_TRUE(watch.take(kNode, 2) == Answer::kFresh);
    EXPECT_TRUE(watch.take(kOther, 2) == Answer::kFresh);
  }
  watch.begin();
  EXPECT_TRUE(watch.take(kOther, 2) == Answer::kFresh);
  for (int tick = 0; tick < 10; ++tick) {
    watch.begin();
    EXPECT_TRUE(watch.take(kNode, 2) == Answer::kOld) << tick;
    EXPECT_TRUE(watch.take(kOther, 2) == Answer::kFresh) << tick;
  }
  watch.begin();
  watch.prompt();
  EXPECT_TRUE(watch.take(kNode, 2) == Answer::kFresh);
}

TEST(AnswerWatch, ABusThatNeverWasPromptIsNotAskedToBe) {
  AnswerWatch watch = watch_of_group(2);
  watch.prompt();
  watch.begin();
  EXPECT_TRUE(watch.take(kNode, 2) == Answer::kFresh);
  watch.begin();
  watch.begin();
  EXPECT_TRUE(watch.take(kNode, 2) == Answer::kFresh);
}

TEST(SensedCounts, CountsOfASensorThatAnswersTwiceDifferentlyAreNotFresh) {
  constexpr NodeMask kPresent = node_bit(kFootNode);
  SensedCounts sensed;
  CanFrame first = canopen::classic_frame(canopen::tpdo_id(1, 101), 8);
  CanFrame second = first;
  second.data[3] = 1;
  for (const bool differs : {false, true}) {
    Inputs inputs;
    sensed.begin();
    EXPECT_TRUE(sensed.take(first, kFootNode, Answer::kFresh));
    EXPECT_EQ(sensed.take(differs ? second : first, kFootNode, Answer::kAgain), !differs);
    sensed.put(inputs, false, kPresent);
    EXPECT_EQ((inputs.flags & kFeetFresh) != 0, !differs);
  }
}

std::uint8_t times_on(Loop& loop, int joint) {
  return loop.bench.drives[joint].device.objects().tpdos[0].times_on();
}

// Too many answers overflow a small controller's FIFO.
TEST(SyncRepair, ADriveThatMissedASyncIsBroughtBackToItsOwnWhileItHoldsTorque) {
  Loop& loop = test::new_can_loop();
  loop.enable();
  const std::uint8_t before = times_on(loop, kNode);
  CanFrame extra = canopen::classic_frame(canopen::kSyncId, 1);
  extra.data[0] = 9;
  loop.bench.drives[kNode].device.receive(extra, 0);
  CanFrame frame;
  while (loop.bench.drives[kNode].device.next(frame, 0)) {
  }
  loop.run(20);
  EXPECT_EQ(times_on(loop, kNode), before + 1);
  EXPECT_EQ(times_on(loop, kNode + 1), before) << "another one is left alone";
  for (int i = 0; i < 50; ++i) {
    loop.tick();
    EXPECT_EQ(loop.inputs.fresh, kAll) << i;
    EXPECT_TRUE(loop.all_in(canopen::cia402::State::kOperationEnabled)) << i;
  }
  EXPECT_EQ(times_on(loop, kNode), before + 1) << "once was enough: it is where it should be";
}

// Nodes being set up take turns. Waiting for one of them would ask no other.
TEST(DriveTelemetry, PassesOverWhoIsBusy) {
  Params params;
  params.joint_count = 5;
  for (int j = 0; j < 5; ++j) params.joint[j].servo_id = static_cast<std::uint8_t>(11 + j);
  DriveTelemetry telemetry(params);
  std::uint8_t last = 0;
  for (int tick = 0; tick < 20; ++tick) {
    CanFrame request;
    bool missed = false;
    const int busy = (tick + 1) % 5;
    ASSERT_TRUE(telemetry.next(request, node_bit(busy), missed)) << tick;
    EXPECT_NE(request.id, std::uint32_t{canopen::sdo_request_id(params.joint[busy].servo_id)});
    EXPECT_NE(static_cast<std::uint8_t>(request.id), last) << "in turn";
    last = static_cast<std::uint8_t>(request.id);
  }
  CanFrame request;
  bool missed = false;
  EXPECT_FALSE(telemetry.next(request, node_bit(5) - 1, missed)) << "all are";
}

TEST(DriveTelemetry, OnlyADriveWithoutTheObjectIsAskedForAnother) {
  using canopen::Abort;
  Params params;
  params.joint_count = 1;
  params.joint[0].servo_id = 11;
  for (const Abort why : {Abort::kGeneral, Abort::kNoObject}) {
    DriveTelemetry telemetry(params);
    CanFrame request;
    bool missed = false;
    ASSERT_TRUE(telemetry.next(request, 0, missed));
    const CanFrame abort =
        canopen::sdo::abort_frame(canopen::sdo_response_id(11), canopen::plan::kTelemetry, why);
    EXPECT_TRUE(telemetry.receive(0, abort));
    ASSERT_TRUE(telemetry.next(request, 0, missed));
    const bool same = canopen::sdo::address_of(request) == canopen::plan::kTelemetry;
    EXPECT_EQ(same, why == Abort::kGeneral);
  }
}

}  // namespace
}  // namespace verp::app
