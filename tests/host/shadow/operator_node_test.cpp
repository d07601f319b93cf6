#include "firmware/app/operator_node.hpp"

#include <gtest/gtest.h>

#include "common/protocol/canopen/sdo_client.hpp"
#include "hal/fake/scripted_can.hpp"
#include "tests/unit/app/operator_bench.hpp"

namespace verp::app::test {
namespace {

using Log = TickLog<>;
using Node = OperatorNode<hal::ScriptedCan, Log>;

Params quick_robot(std::uint32_t period_us) {
  Params params = kRobot;
  params.baud = 1'000'000;
  params.period_us = period_us;
  return params;
}

struct Desk {
  explicit Desk(std::uint32_t period_us = 10'000)
      : params(quick_robot(period_us)), node(bus, params, OperatorSetup{}, log) {}
  int sent() {
    CanFrame frame;
    int count = 0;
    while (bus.take_sent(frame)) ++count;
    return count;
  }
  void tick() {
    ++record.inputs.tick;
    node.record(record, state, outputs);
  }
  hal::ScriptedCan bus;
  Params params;
  Log log{no_images};
  Node node;
  TickRecord record;
  State state;
  Outputs outputs;
};

// The loop sees the frames of its robot, and no others; the node answers behind a tick only.
TEST(OperatorNode, TakesWhatIsItsOwnAndSendsBehindATickOnly) {
  auto& desk = renewed<Desk>();
  EXPECT_EQ(desk.sent(), 0) << "its heartbeat is the master's";
  canopen::SdoClient client(Node::kNode);
  std::uint8_t crc[4];
  client.upload(object("model_information"), crc, 4, canopen::SdoClient::Mode::kPlain, 0);
  CanFrame frame;
  ASSERT_TRUE(client.next(frame, 0));
  desk.bus.inject(frame, 10);
  desk.bus.inject(canopen::classic_frame(canopen::tpdo_id(1, 3), 6), 20);
  ASSERT_TRUE(desk.node.poll(frame, 1000));
  EXPECT_EQ(frame.id, std::uint32_t{canopen::tpdo_id(1, 3)});
  EXPECT_FALSE(desk.node.poll(frame, 1000));
  EXPECT_EQ(desk.sent(), 0);
  desk.tick();
  bool answered = false;
  while (desk.bus.take_sent(frame)) {
    answered = answered || frame.id == canopen::sdo_response_id(Node::kNode);
  }
  EXPECT_TRUE(answered);
}

TEST(OperatorNode, TellsOfEachTickInItsOrder) {
  auto& desk = renewed<Desk>();
  desk.tick();
  desk.sent();
  desk.record.inputs.mailbox = 5;
  desk.record.digest.chain = 0x1122334455667788;
  desk.tick();
  const unsigned numbers[] = {2, 3, 4};
  CanFrame frame;
  for (const unsigned number : numbers) {
    ASSERT_TRUE(desk.bus.take_sent(frame));
    EXPECT_EQ(frame.id, std::uint32_t{canopen::tpdo_id(number, Node::kNode)});
    EXPECT_EQ(frame.size, canopen::published::kFrameBytes);
    if (number == 2) {
      EXPECT_EQ(canopen::get_le(frame.data, 8), desk.record.digest.chain);
    }
    if (number == 3) {
      EXPECT_EQ(canopen::get_le(frame.data, 2), desk.record.inputs.tick);
    }
  }
  EXPECT_FALSE(desk.bus.take_sent(frame));
}

TEST(OperatorNode, IsSilentWhereTheBusHasNoRoom) {
  auto& desk = renewed<Desk>(1000u);
  desk.tick();
  EXPECT_EQ(desk.sent(), 0);
}

}  // namespace
}  // namespace verp::app::test
