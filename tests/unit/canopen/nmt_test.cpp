#include "common/protocol/canopen/nmt.hpp"

#include <gtest/gtest.h>

namespace verp::canopen {
namespace {

constexpr std::uint8_t kNode = 9;

NmtSlave started() {
  NmtSlave slave(kNode);
  slave.initialised();
  return slave;
}

// CiA 301's state diagram.
TEST(NmtSlave, ObeysEachCommandFromEachState) {
  const NmtCommand ways[] = {NmtCommand::kStart, NmtCommand::kStop,
                             NmtCommand::kEnterPreOperational};
  const NmtState states[] = {NmtState::kOperational, NmtState::kStopped, NmtState::kPreOperational};
  for (const NmtCommand before : ways) {
    for (unsigned i = 0; i < 3; ++i) {
      NmtSlave slave = started();
      slave.receive(nmt_frame(before, kNode));
      const bool changes = before != ways[i];
      EXPECT_TRUE(slave.receive(nmt_frame(ways[i], 0)) ==
                  (changes ? NmtEvent::kState : NmtEvent::kNone));
      EXPECT_TRUE(slave.state() == states[i]);
    }
    NmtSlave slave = started();
    slave.receive(nmt_frame(before, kNode));
    EXPECT_TRUE(slave.receive(nmt_frame(NmtCommand::kResetNode, kNode)) == NmtEvent::kResetNode);
    EXPECT_TRUE(slave.state() == NmtState::kInitialising);
    slave = started();
    EXPECT_TRUE(slave.receive(nmt_frame(NmtCommand::kResetCommunication, 0)) ==
                NmtEvent::kResetCommunication);
  }
}

TEST(NmtSlave, IgnoresOtherNodesAndOtherFrames) {
  NmtSlave slave = started();
  EXPECT_TRUE(slave.receive(nmt_frame(NmtCommand::kStart, kNode + 1)) == NmtEvent::kNone);
  Frame strange = nmt_frame(NmtCommand::kStart, kNode);
  strange.size = 1;
  EXPECT_TRUE(slave.receive(strange) == NmtEvent::kNone);
  strange = nmt_frame(NmtCommand::kStart, kNode);
  strange.extended = true;
  EXPECT_TRUE(slave.receive(strange) == NmtEvent::kNone);
  strange = nmt_frame(static_cast<NmtCommand>(3), kNode);
  EXPECT_TRUE(slave.receive(strange) == NmtEvent::kNone);
  EXPECT_TRUE(slave.state() == NmtState::kPreOperational);
  NmtSlave starting(kNode);
  EXPECT_TRUE(starting.receive(nmt_frame(NmtCommand::kStart, kNode)) == NmtEvent::kNone)
      << "a node that is starting does not listen";
}

TEST(HeartbeatProducer, BootsOnceThenBeatsWithoutBursts) {
  HeartbeatProducer producer(kNode);
  producer.set_period_ms(100);
  Frame frame;
  EXPECT_FALSE(producer.next(0, NmtState::kInitialising, frame));
  EXPECT_TRUE(producer.next(0, NmtState::kPreOperational, frame));
  EXPECT_EQ(frame.id, 0x709u);
  EXPECT_EQ(frame.size, 1);
  EXPECT_EQ(frame.data[0], 0) << "the boot-up message";
  EXPECT_FALSE(producer.next(99'999, NmtState::kPreOperational, frame));
  EXPECT_TRUE(producer.next(100'000, NmtState::kPreOperational, frame));
  EXPECT_EQ(frame.data[0], 127);
  EXPECT_FALSE(producer.next(150'000, NmtState::kOperational, frame));
  EXPECT_TRUE(producer.next(950'000, NmtState::kOperational, frame)) << "late";
  EXPECT_EQ(frame.data[0], 5);
  EXPECT_FALSE(producer.next(950'000, NmtState::kOperational, frame)) << "no burst";
  EXPECT_TRUE(producer.next(1'050'000, NmtState::kStopped, frame));
  EXPECT_EQ(frame.data[0], 4);
  producer.set_period_ms(0);
  EXPECT_FALSE(producer.next(9'000'000, NmtState::kOperational, frame)) << "1017h is 0";
  EXPECT_FALSE(producer.next(9'000'000, NmtState::kInitialising, frame)) << "a reset";
  EXPECT_TRUE(producer.next(9'000'001, NmtState::kPreOperational, frame));
  EXPECT_EQ(frame.data[0], 0);
  producer.restart();
  EXPECT_TRUE(producer.next(9'000'002, NmtState::kPreOperational, frame)) << "a quick reset";
  EXPECT_EQ(frame.data[0], 0);
}

constexpr std::uint32_t watch(std::uint8_t node, std::uint16_t time_ms) {
  return std::uint32_t{node} << 16 | time_ms;
}

TEST(HeartbeatConsumer, WatchesFromTheFirstHeartbeatOnAndTellsALossOnce) {
  HeartbeatConsumer<2> consumer;
  std::uint8_t subindex = 0;
  EXPECT_TRUE(consumer.write(1, watch(kNode, 50)) == Abort::kNone);
  EXPECT_FALSE(consumer.next_lost(10'000'000, subindex)) << "no heartbeat yet: unknown, not lost";
  EXPECT_TRUE(consumer.life(1) == Life::kUnknown);
  const Frame beat = heartbeat_frame(kNode, NmtState::kOperational);
  EXPECT_TRUE(consumer.receive(beat, 1000, subindex) == LifeEvent::kAlive);
  EXPECT_EQ(subindex, 1);
  EXPECT_TRUE(consumer.receive(beat, 2000, subindex) == LifeEvent::kNone);
  EXPECT_FALSE(consumer.next_lost(51'999, subindex));
  EXPECT_TRUE(consumer.next_lost(52'000, subindex));
  EXPECT_EQ(subindex, 1);
  EXPECT_FALSE(consumer.next_lost(99'000, subindex)) << "told once";
  EXPECT_TRUE(consumer.receive(beat, 100'000, subindex) == LifeEvent::kAlive) << "back again";
  EXPECT_TRUE(consumer.receive(heartbeat_frame(kNode, NmtState::kStopped), 101'000, subindex) ==
              LifeEvent::kState);
  EXPECT_TRUE(consumer.state(1) == NmtState::kStopped);
  EXPECT_TRUE(consumer.receive(heartbeat_frame(kNode, NmtState::kInitialising), 102'000,
                               subindex) == LifeEvent::kBooted)
      << "a node that reboots is told, though it was never silent";
  EXPECT_FALSE(consumer.next_lost(9'000'000, subindex)) << "told already";
  EXPECT_TRUE(consumer.life(1) == Life::kUnknown);
  EXPECT_TRUE(consumer.receive(heartbeat_frame(kNode + 1, NmtState::kOperational), 0, subindex) ==
              LifeEvent::kNone)
      << "not watched";
}

TEST(HeartbeatConsumer, RefusesToWatchANodeTwice) {
  HeartbeatConsumer<3> consumer;
  EXPECT_TRUE(consumer.write(1, watch(5, 100)) == Abort::kNone);
  EXPECT_TRUE(consumer.write(2, watch(5, 200)) == Abort::kIncompatibleParameter);
  EXPECT_TRUE(consumer.write(1, watch(5, 200)) == Abort::kNone) << "the same entry may change";
  EXPECT_TRUE(consumer.write(2, watch(5, 0)) == Abort::kNone) << "a time of 0 watches nobody";
  EXPECT_TRUE(consumer.write(3, watch(128, 9)) == Abort::kNone);
  EXPECT_TRUE(consumer.life(3) == Life::kUnused);
  EXPECT_EQ(consumer.value(1), watch(5, 200));
  EXPECT_TRUE(consumer.write(0, 0) == Abort::kNoSubindex);
  EXPECT_TRUE(consumer.write(4, 0) == Abort::kNoSubindex);
}

}  // namespace
}  // namespace verp::canopen
