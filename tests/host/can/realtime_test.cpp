#include "host/twin/can/realtime_server.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "common/protocol/canopen/sync.hpp"
#include "tests/host/can/can_bench.hpp"

namespace verp::can {
namespace {

CanFrame ask_1000(std::uint8_t node) {
  CanFrame frame = canopen::classic_frame(canopen::sdo_request_id(node), 8);
  frame.data[0] = 0x40;
  frame.data[2] = 0x10;
  return frame;
}

class CanRealTime : public ::testing::Test {
 protected:
  void hear(const CanFrame& frame, std::uint64_t clock_us) { hear(frame, clock_us, clock_us); }
  void hear(const CanFrame& frame, std::uint64_t came_us, std::uint64_t clock_us) {
    server.hear(std::vector{RealtimeServer::ReceivedFrame{frame, came_us}}, clock_us, answer);
  }

  test::CanBench bench{3};
  RealtimeServer server{bench.bus};
  std::vector<CanFrame> answer;
};

TEST_F(CanRealTime, TimeBeginsWithTheFirstFrame) {
  server.turn(5'000'000, answer);
  EXPECT_FALSE(server.begun());
  EXPECT_EQ(bench.bus.now_us(), 0u);
  hear(ask_1000(1), 9'000'000);
  EXPECT_TRUE(server.begun());
  EXPECT_TRUE(answer.empty()) << "the frame takes its time on the wire";
  server.turn(9'010'000, answer);
  EXPECT_EQ(bench.bus.now_us(), 10'000u);
  const auto response = std::find_if(answer.begin(), answer.end(), [](const CanFrame& each) {
    return each.id == canopen::sdo_response_id(1);
  });
  ASSERT_NE(response, answer.end());
  EXPECT_EQ(canopen::get_le(response->data + 4, 4), 0x00020192u);
}

TEST_F(CanRealTime, FramesReachTheBusWhenTheyCame) {
  std::vector<std::uint64_t> begun_us;
  bench.bus.set_listener([&](const CanFrame& frame, std::uint64_t begin_ns, std::uint64_t) {
    if (frame.id == canopen::kSyncId) begun_us.push_back(begin_ns / 1000);
  });
  hear(canopen::classic_frame(canopen::kSyncId, 0), 1000);
  for (const std::uint64_t at_us : {21'000u, 33'500u, 60'000u}) {
    hear(canopen::classic_frame(canopen::kSyncId, 0), at_us);
  }
  server.turn(80'000, answer);
  ASSERT_EQ(begun_us.size(), 4u);
  EXPECT_EQ(begun_us[1], 20'000u);
  EXPECT_EQ(begun_us[2], 32'500u);
  EXPECT_EQ(begun_us[3], 59'000u);
}

TEST_F(CanRealTime, FramesKeepTheirOrder) {
  std::vector<std::uint32_t> heard;
  bench.bus.set_listener([&](const CanFrame& frame, std::uint64_t, std::uint64_t) {
    if (frame.id == 0x213 || frame.id == canopen::kSyncId) heard.push_back(frame.id);
  });
  for (int i = 0; i < 10; ++i) {
    hear(canopen::classic_frame(0x213, 4), 1000);
    hear(canopen::classic_frame(canopen::kSyncId, 0), 1000);
  }
  server.turn(50'000, answer);
  ASSERT_EQ(heard.size(), 20u);
  for (std::size_t i = 0; i < heard.size(); ++i) {
    EXPECT_EQ(heard[i], i % 2 == 0 ? 0x213u : canopen::kSyncId) << i;
  }
}

TEST_F(CanRealTime, CountsWhatIsFasterThanTheWire) {
  for (int i = 0; i < 1000; ++i) hear(ask_1000(1), 1000);
  EXPECT_EQ(server.counters().frames, 1000u);
  EXPECT_EQ(server.counters().dropped, 1000 - hal::kCanQueue);
  server.turn(500'000, answer);
  hear(ask_1000(1), 500'000);
  EXPECT_EQ(server.counters().dropped, 1000 - hal::kCanQueue) << "there is room again";
}

// A slower PC would fall further behind each turn.
TEST_F(CanRealTime, SkipsWhatItCannotMakeUpFor) {
  hear(ask_1000(1), 1'000'000);
  EXPECT_TRUE(server.kept_up()) << "nothing was skipped";
  for (int turn = 1; turn <= 20; ++turn) {
    const std::uint64_t clock_us = 1'000'000u + 500'000u * static_cast<unsigned>(turn);
    server.turn(clock_us, answer);
    EXPECT_EQ(bench.bus.now_us(), 50'000u * static_cast<unsigned>(turn));
    server.finished(clock_us);
    EXPECT_EQ(server.counters().skipped_us, 450'000u * static_cast<unsigned>(turn));
  }
  EXPECT_FALSE(server.kept_up());
  EXPECT_EQ(server.counters().late, 0u);
  hear(ask_1000(1), 10'500'000);
  EXPECT_EQ(bench.bus.now_us(), 1'000'000u);
  for (std::uint64_t clock_us = 11'000'000; clock_us <= 12'100'000; clock_us += 50'000) {
    server.turn(clock_us, answer);
  }
  EXPECT_EQ(bench.bus.now_us(), 2'100'000u);
  EXPECT_EQ(server.counters().skipped_us, 9'000'000u);
  EXPECT_TRUE(server.kept_up()) << "for a second";
}

// Frames come faster than this PC handles them.
TEST_F(CanRealTime, IsNeverFurtherBehindTheClockHoweverOldTheFramesAre) {
  hear(ask_1000(1), 0);
  constexpr std::uint64_t kFrames = 1000, kApart_us = 2000, kTakes_us = 50'000;
  for (std::uint64_t i = 1; i <= kFrames; ++i) {
    hear(ask_1000(1), i * kApart_us, i * kTakes_us);
    const std::uint64_t behind_us =
        i * kTakes_us - bench.bus.now_us() - server.counters().skipped_us;
    ASSERT_LE(behind_us, RealtimeServer::kMostBehind_us) << i;
  }
  EXPECT_GT(bench.bus.now_us(), kFrames * kTakes_us / 4) << "time never stood";
  constexpr std::uint64_t kEnd_us = kFrames * kTakes_us;
  server.turn(kEnd_us, answer);
  answer.clear();
  hear(ask_1000(2), kEnd_us + 1000);
  server.turn(kEnd_us + 5000, answer);
  EXPECT_TRUE(std::any_of(answer.begin(), answer.end(), [](const CanFrame& each) {
    return each.id == canopen::sdo_response_id(2);
  }));
}

// The twin takes three times as long as the clock: waiting frames must share turns.
TEST_F(CanRealTime, WhoAsksMoreOftenThanThereAreTurnsIsAnsweredInTime) {
  hear(ask_1000(1), 0);
  constexpr std::uint64_t kApart_us = 5000, kEnd_us = 10'000'000, kSlow = 3;
  std::deque<std::uint64_t> asked_us;
  std::uint64_t next_us = kApart_us, worst_us = 0, questions = 0, answers = 0;
  for (std::uint64_t clock_us = 1000; clock_us < kEnd_us;) {
    std::vector<RealtimeServer::ReceivedFrame> waiting;
    for (; next_us <= clock_us; next_us += kApart_us, ++questions) {
      waiting.push_back({ask_1000(1), next_us});
      asked_us.push_back(next_us);
    }
    const std::uint64_t before_us = bench.bus.now_us();
    answer.clear();
    waiting.empty() ? server.turn(clock_us, answer) : server.hear(waiting, clock_us, answer);
    clock_us += kSlow * (bench.bus.now_us() - before_us) + 100;
    for (const CanFrame& each : answer) {
      if (each.id != canopen::sdo_response_id(1) || asked_us.empty()) continue;
      worst_us = std::max(worst_us, clock_us - asked_us.front());
      asked_us.pop_front();
      ++answers;
    }
  }
  EXPECT_GT(questions, 1900u);
  EXPECT_GT(answers, questions - 100);
  EXPECT_EQ(server.counters().dropped, 0u);
  EXPECT_LT(worst_us, 500'000u);
}

TEST_F(CanRealTime, SaysHowLateItIs) {
  hear(ask_1000(1), 1000);
  server.finished(1500);
  EXPECT_EQ(server.counters().late, 0u);
  server.finished(8000);
  EXPECT_EQ(server.counters().late, 1u);
  EXPECT_EQ(server.counters().worst_late_us, 7000u);
}

}  // namespace
}  // namespace verp::can
