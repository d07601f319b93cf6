#include "firmware/app/operator_node.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "common/protocol/canopen/sdo_client.hpp"
#include "firmware/app/operator_device.hpp"
#include "firmware/app/tick_log.hpp"
#include "hal/fake/scripted_can.hpp"
#include "tests/hil/operator_desk.hpp"
#include "tests/unit/app/operator_bench.hpp"

namespace verp::app::test {
namespace {

using Log = TickLog;
using Node = OperatorNode;

Params quick_robot(std::uint32_t period_us) {
  Params params = kRobot;
  params.baud = 1'000'000;
  params.period_us = period_us;
  return params;
}

struct Desk {
  explicit Desk(std::uint32_t period_us = 10'000)
      : params(quick_robot(period_us)), node(bus, params, registers, log) {}
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
  OperatorRegisters registers{params, OperatorSetup{}, log};
  Node node;
  TickRecord record;
  State state;
  Outputs outputs;
};

CanFrame question() {
  canopen::SdoClient client(Node::kNode);
  std::uint8_t crc[4];
  client.upload(object("model_information"), crc, 4, canopen::SdoClient::Mode::kPlain, 0);
  CanFrame frame;
  EXPECT_TRUE(client.next(frame, 0));
  return frame;
}

// Bring-up takes seconds or fails.
TEST(OperatorNode, AnswersAtOnceBeforeTheFirstTick) {
  auto& desk = renewed<Desk>();
  desk.bus.inject(question(), 10);
  CanFrame frame;
  EXPECT_FALSE(desk.node.poll(frame, 1000));
  ASSERT_TRUE(desk.bus.take_sent(frame));
  EXPECT_EQ(frame.id, std::uint32_t{canopen::sdo_response_id(Node::kNode)});
}

TEST(OperatorNode, TakesWhatIsItsOwnAndSendsBehindATickOnly) {
  auto& desk = renewed<Desk>();
  EXPECT_EQ(desk.sent(), 0) << "its heartbeat is the master's";
  desk.tick();
  desk.sent();
  desk.bus.inject(question(), 10);
  CanFrame frame;
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

// `verp shadow`, `verp bus` and a third-party poller.
TEST(OperatorNode, AnswersThreeClientsAtOnceEachByItsOwnChannel) {
  namespace plan = canopen::plan;
  auto& desk = renewed<Desk>();
  desk.tick();
  canopen::SdoClient clients[] = {canopen::SdoClient(Node::kNode),
                                  canopen::SdoClient(canopen::further_sdo(plan::kWatcherSdo)),
                                  canopen::SdoClient(canopen::further_sdo(plan::kToolSdo))};
  constexpr canopen::Address kAsked[] = {{0x1008, 0}, {0x1201, 1}, {0x1202, 2}};
  const std::string expected[] = {"VERP controller", "\xD1\x06", "\xC2\x06"};
  std::uint8_t got[3][32];
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 3; ++i) {
      std::memset(got[i], 0, sizeof got[i]);
      clients[i].upload(kAsked[i], got[i], sizeof got[i], canopen::SdoClient::Mode::kPlain, 0);
    }
    for (int tick = 0; tick < 10; ++tick) {
      CanFrame frame;
      for (canopen::SdoClient& each : clients) {
        while (each.next(frame, 0)) desk.bus.inject(frame, 10);
      }
      while (desk.node.poll(frame, 1000)) {
      }
      desk.tick();
      while (desk.bus.take_sent(frame)) {
        for (canopen::SdoClient& each : clients) each.receive(frame, 0);
      }
    }
    for (int i = 0; i < 3; ++i) {
      ASSERT_EQ(clients[i].state(), canopen::SdoClient::State::kDone) << i;
      EXPECT_EQ(reinterpret_cast<const char*>(got[i]), expected[i]) << i;
    }
  }
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

// A tool that resets all nodes must not silence it.
TEST(OperatorNode, ObeysNoOtherMaster) {
  using canopen::NmtCommand;
  auto& desk = renewed<Desk>();
  desk.tick();
  const int told = desk.sent();
  EXPECT_GT(told, 0);
  for (const std::uint8_t to : {std::uint8_t{0}, Node::kNode}) {
    for (const auto command : {NmtCommand::kStop, NmtCommand::kEnterPreOperational,
                               NmtCommand::kResetNode, NmtCommand::kResetCommunication}) {
      desk.bus.inject(canopen::nmt_frame(command, to), 10);
      CanFrame frame;
      EXPECT_TRUE(desk.node.poll(frame, 1000)) << "the loop counts a stray";
      desk.tick();
      EXPECT_GE(desk.sent(), 2) << "digest and record";
    }
  }
}

TEST(OperatorNode, StandsBesideAnOperatorsPort) {
  verp::test::OperatorDesk port;
  hal::ScriptedCan bus;
  const Params params = quick_robot(10'000);
  Log log{no_images};
  OperatorDevice device(port.controller_end(), params, {}, log);
  port.serve = [&] {
    while (device.poll()) {
    }
  };
  Node node(bus, params, device.registers(), log);
  EXPECT_TRUE(port.write(reg("request"), {0}));
  EXPECT_TRUE(port.order_walk(1));
  TickRecord record;
  record.inputs.tick = 77;
  record.inputs.command = device.order(77).command;
  record.digest.chain = 0x1122334455667788;
  EXPECT_EQ(record.inputs.command.request, Request::kWalk);
  canopen::SdoClient client(Node::kNode);
  std::uint8_t request = 0;
  client.upload(object("request"), &request, 1, canopen::SdoClient::Mode::kPlain, 0);
  CanFrame frame;
  ASSERT_TRUE(client.next(frame, 0));
  bus.inject(frame, 10);
  EXPECT_FALSE(node.poll(frame, 1000)) << "the loop sees nothing of it";
  device.record(record, State{}, Outputs{});
  node.tell(record.inputs);
  EXPECT_EQ(port.read<std::uint32_t>(reg("tick")), 77u);
  bool told = false;
  while (bus.take_sent(frame)) {
    if (frame.id == canopen::sdo_response_id(Node::kNode)) client.receive(frame, 0);
    if (frame.id != canopen::tpdo_id(canopen::published::kDigestPdo, Node::kNode)) continue;
    EXPECT_EQ(canopen::get_le(frame.data, 8), record.digest.chain);
    told = true;
  }
  EXPECT_TRUE(told);
  EXPECT_EQ(request, static_cast<std::uint8_t>(Request::kWalk));
}

TEST(OperatorNode, IsSilentWhereTheBusHasNoRoom) {
  auto& desk = renewed<Desk>(1000u);
  desk.tick();
  EXPECT_EQ(desk.sent(), 0);
}

}  // namespace
}  // namespace verp::app::test
