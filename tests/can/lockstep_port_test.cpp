#include "tests/target/lockstep_port.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "common/control/state.hpp"
#include "common/model/image.hpp"
#include "common/record/tick_record.hpp"
#include "host/twin/can/virtual_can.hpp"
#include "tests/can/can_world.hpp"
#include "tests/host/bus/fake_plant.hpp"

namespace verp::can {
namespace {

using test::OwnVcan;

class CanLockstepPort : public ::testing::Test {
 protected:
  void greet() {
    const lockstep::Hello hello{.core_version = kCoreVersion,
                                .params_size = sizeof(Params),
                                .params_crc = params_crc(params),
                                .record_size = sizeof(TickRecord),
                                .state_size = sizeof(State)};
    std::uint8_t part[kMaxCanData];
    for (std::uint32_t i = 0; i < lockstep::kCanHelloParts; ++i) {
      __builtin_memcpy(part, reinterpret_cast<const std::uint8_t*>(&hello) + i * kMaxCanData,
                       sizeof part);
      ASSERT_TRUE(controller.send(lockstep::can_message(lockstep::kCanHelloId + i, part)));
    }
    serve();
    CanFrame frame;
    lockstep::HelloReply reply;
    ASSERT_TRUE(controller.await(frame, kSoon_us));
    ASSERT_TRUE(lockstep::take_message(frame, lockstep::kCanHelloReplyId, reply));
    ASSERT_EQ(reply.verdict, lockstep::Verdict::kAccepted);
  }

  void ask(std::uint8_t sequence) {
    ASSERT_TRUE(controller.send(lockstep::can_message(
        lockstep::kCanAdvanceId, lockstep::CanAdvance{.sequence = sequence, .timeout_us = 1000})));
  }

  void serve() {
    while (port.serve(server, kSoon_us)) {
    }
  }

  std::vector<int> answers() {
    std::vector<int> heard;
    CanFrame frame;
    lockstep::CanAdvanced answer;
    while (controller.await(frame, kSoon_us)) {
      if (lockstep::take_message(frame, lockstep::kCanAdvancedId, answer)) {
        heard.push_back(answer.sequence);
      }
    }
    return heard;
  }

  static constexpr std::uint32_t kSoon_us = 30'000;
  const OwnVcan vcan;
  Params params = test::bus_params(5);
  test::FakePlant plant;
  VirtualCan twin{params, plant};
  LockstepServer server{params, twin, {}};
  LockstepPort port{vcan.endpoint()};
  link::CanPort controller{vcan.endpoint()};
};

TEST_F(CanLockstepPort, AnswersEachQuestion) {
  greet();
  for (std::uint8_t sequence = 1; sequence <= 3; ++sequence) {
    ask(sequence);
    serve();
    EXPECT_EQ(answers(), std::vector<int>{sequence});
  }
  EXPECT_EQ(server.counters().polls, 3u);
}

// A stopped PC finds the question and its repetition; two answers overflow a small FIFO.
TEST_F(CanLockstepPort, AnswersOnceWhenItWasLate) {
  greet();
  ask(1);
  ask(1);
  ask(1);
  serve();
  EXPECT_EQ(answers(), std::vector<int>{1});
  EXPECT_EQ(server.counters().polls, 1u);
  ask(1);
  serve();
  EXPECT_EQ(answers(), std::vector<int>{1}) << "the answer was lost, and is asked for again";
  ask(2);
  serve();
  EXPECT_EQ(answers(), std::vector<int>{2});
}

}  // namespace
}  // namespace verp::can
