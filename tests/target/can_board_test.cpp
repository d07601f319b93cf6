#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "host/boards/board/emulated_board.hpp"
#include "host/boards/board/qemu.hpp"
#include "host/os/link/can_port.hpp"

// Run it inside tests/support/with-can; VERP_TEST_BOARD names the board.
namespace verp::board {
namespace {

constexpr std::uint32_t kReady = 0x700, kEnd = 0x7FF;
constexpr std::uint32_t kPatience_us = 20'000'000;

class Echo {
 public:
  Echo()
      : board_(find_emulated_board(name())),
        firmware_({.board = board_,
                   .image = firmware_image(board_, "can"),
                   .arguments = {},
                   .can_interface = "vcan0"}) {
    CanFrame frame;
    if (!take(frame) || frame.id != kReady) {
      ADD_FAILURE() << firmware_.described("did not say that it is ready");
    }
  }

  bool send(const CanFrame& frame) { return port_.send(frame); }
  bool take(CanFrame& frame) { return port_.poll(frame, kPatience_us); }
  CanFrame end() {
    CanFrame frame;
    frame.id = kEnd;
    EXPECT_TRUE(send(frame));
    EXPECT_TRUE(take(frame));
    EXPECT_EQ(firmware_.wait(std::chrono::seconds(60)), 0) << firmware_.output();
    return frame;
  }

 private:
  static std::string name() {
    const char* name = std::getenv("VERP_TEST_BOARD");
    return name != nullptr ? name : "VERP_TEST_BOARD is not set";
  }

  link::CanPort port_{{.kind = link::Endpoint::Kind::kCan, .place = "vcan0"}};
  EmulatedBoard board_;
  QemuProcess firmware_;
};

/// Without the two special identifiers, with room for one more.
CanFrame any_frame(std::mt19937& random) {
  CanFrame frame;
  frame.extended = random() % 4 == 0;
  frame.id = static_cast<std::uint32_t>(random() % (frame.extended ? 0x1FFFFFFFu : kReady - 1));
  frame.size = static_cast<std::uint8_t>(random() % 9);
  for (unsigned i = 0; i < frame.size; ++i) frame.data[i] = static_cast<std::uint8_t>(random());
  return frame;
}

void expect_no_errors(const CanFrame& counts) {
  ASSERT_EQ(counts.size, 4);
  constexpr const char* kWhat[] = {"errors", "overruns", "bus-offs", "dropped"};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(counts.data[i], 0) << kWhat[i];
}

TEST(CanBoard, AnswersFramesOfEveryKindWholeAndOnce) {
  Echo board;
  std::mt19937 random(4);
  for (int n = 0; n < 1000; ++n) {
    CanFrame frame = any_frame(random);
    ASSERT_TRUE(board.send(frame));
    CanFrame answer;
    ASSERT_TRUE(board.take(answer)) << "frame " << n;
    ++frame.id;
    ASSERT_TRUE(answer == frame) << "frame " << n;
  }
  expect_no_errors(board.end());
}

// Five frames at a time, like drives that answer a SYNC.
TEST(CanBoard, LosesNoneOfAGroupsAnswers) {
  Echo board;
  std::mt19937 random(5);
  for (int n = 0; n < 200; ++n) {
    std::vector<CanFrame> sent(5);
    for (unsigned drive = 0; drive < sent.size(); ++drive) {
      sent[drive].id = 0x181 + 2 * drive;
      sent[drive].size = 8;
      for (std::uint8_t& byte : sent[drive].data) byte = static_cast<std::uint8_t>(random());
      ASSERT_TRUE(board.send(sent[drive]));
    }
    for (std::size_t i = 0; i < sent.size(); ++i) {
      CanFrame answer;
      ASSERT_TRUE(board.take(answer)) << "group " << n;
      --answer.id;
      const auto found = std::find(sent.begin(), sent.end(), answer);
      ASSERT_TRUE(found != sent.end()) << "group " << n << ": another frame, or one twice";
      *found = {};
    }
  }
  expect_no_errors(board.end());
}

}  // namespace
}  // namespace verp::board
