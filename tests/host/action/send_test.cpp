#include "host/author/action/send.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "host/author/action/kept.hpp"
#include "host/twin/bus/client.hpp"
#include "tests/host/action/robots.hpp"
#include "tests/host/action/running_board.hpp"

namespace verp::action {
namespace {

using verp::test::RunningBoard;
using Image = std::vector<std::uint8_t>;

const Params& robot() {
  return test::generic21().params;
}

Image acts(std::size_t count, const Params& params = robot()) {
  std::vector<std::string> texts;
  for (std::size_t i = 1; i <= count; ++i) {
    texts.push_back("action a" + std::to_string(i) + "\nframe 0.5\n  l_elbow -40\n");
  }
  return kept_image(test::generic21().make(texts), params);
}

SendOptions stopping(std::function<bool(std::size_t)> went) {
  SendOptions options;
  options.went = std::move(went);
  return options;
}

class SendActions : public ::testing::Test {
 protected:
  SendActions() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    place_ = (std::filesystem::temp_directory_path() /
              ("verp-send-" + std::to_string(::getpid()) + info->name()))
                 .string();
  }
  ~SendActions() override { std::filesystem::remove(place_); }

  RunningBoard& start(const std::function<void(RunningBoard&)>& prepare = {}) {
    board_.reset();
    std::filesystem::remove(place_);
    board_.emplace(robot(), old_, "unix-listen:" + place_, prepare);
    while (!board_->port.opened) std::this_thread::yield();
    return *board_;
  }
  /// The error, or "".
  std::string send(const Image& image, SendOptions options = {}) {
    options.robot = options.robot.empty() ? robot().name : options.robot;
    options.actions = 4;
    try {
      const auto port = serial_action_port(link::parse_endpoint("unix:" + place_), 200);
      return send_actions(*port, image, options) ? "" : "stopped";
    } catch (const bus::DeviceError& error) {
      return error.what();
    }
  }
  void expect_refused(const Image& image, const std::string& why) {
    const std::string told = send(image);
    EXPECT_NE(told.find(why), std::string::npos) << told;
    EXPECT_EQ(told.find('\n'), std::string::npos) << "one line";
    board_->stop();
    EXPECT_TRUE(board_->holds(old_)) << why;
    EXPECT_EQ(board_->starts, 1) << why;
  }

  const Image old_ = acts(2), fresh_ = acts(4);
  std::string place_;
  std::optional<RunningBoard> board_;
};

TEST_F(SendActions, TheBoardStartsAnewWithThem) {
  RunningBoard& board = start();
  EXPECT_EQ(send(fresh_), "");
  EXPECT_EQ(send(fresh_), "") << "and once more";
  board.stop();
  EXPECT_TRUE(board.holds(fresh_));
  EXPECT_EQ(board.starts, 3);
}

TEST_F(SendActions, ACableThatIsPulledAtAnyBlockCostsNothing) {
  const int blocks = static_cast<int>((fresh_.size() + 127) / 128);
  ASSERT_GE(blocks, 3);
  for (int pulled = 0; pulled < blocks; ++pulled) {
    RunningBoard& board = start();
    int block = 0;
    const std::string told = send(fresh_, stopping([&](std::size_t) { return block++ != pulled; }));
    EXPECT_EQ(told, pulled < blocks - 1 ? "stopped" : "");
    EXPECT_EQ(send(fresh_), "") << pulled;
    board.stop();
    EXPECT_TRUE(board.holds(fresh_)) << pulled;
  }
}

TEST_F(SendActions, ABoardThatFallsSilentInTheMiddleIsTold) {
  RunningBoard& board = start();
  const std::string told = send(fresh_, stopping([&](std::size_t) { return board.stop(), true; }));
  EXPECT_NE(told.find("did not answer"), std::string::npos) << told;
  EXPECT_TRUE(board.holds(old_));
}

TEST_F(SendActions, ABadCableCostsTimeOnly) {
  RunningBoard& board = start([](RunningBoard& its) { its.port.flips_per_million = 400; });
  EXPECT_EQ(send(fresh_), "");
  board.stop();
  EXPECT_TRUE(board.holds(fresh_));
}

TEST_F(SendActions, OfAnotherRobotAreRefused) {
  start();
  SendOptions of_op3;
  of_op3.robot = "op3";
  EXPECT_NE(send(fresh_, of_op3).find("its robot is generic21"), std::string::npos);
  Params other = robot();
  other.joint[3].lower_rad -= 0.1F;
  expect_refused(acts(4, other), "for another robot");
}

TEST_F(SendActions, DamagedOnesAreRefused) {
  start();
  Image image = fresh_;
  image[image.size() / 2] ^= 1;
  expect_refused(image, "damaged");
}

TEST_F(SendActions, MoreThanThereIsRoomForIsRefusedBeforeAnythingIsErased) {
  start();
  expect_refused(Image(64 * 1024), "no room for 65536 bytes");
  EXPECT_EQ(board_->other->erases(), 0u);
}

TEST_F(SendActions, ARobotThatHoldsTorqueTakesNone) {
  start([](RunningBoard& board) { board.armed = true; });
  expect_refused(fresh_, "its servos hold torque");
}

TEST_F(SendActions, AFlashThatDoesNotKeepThemIsTold) {
  start([](RunningBoard& board) { board.other->refuse(1); });
  expect_refused(fresh_, "its flash did not keep a block");
}

// The sender waits while the board erases.
TEST_F(SendActions, APlaceIsMadeWhereOneWasUsed) {
  RunningBoard& board = start();
  EXPECT_EQ(send(fresh_, stopping([](std::size_t) { return false; })), "stopped");
  EXPECT_EQ(send(acts(4)), "");
  board.stop();
  EXPECT_GE(board.other->erases(), 1u);
  EXPECT_TRUE(board.holds(fresh_));
}

}  // namespace
}  // namespace verp::action
