#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "common/action/kept.hpp"
#include "host/author/action/send.hpp"
#include "tests/target/serial_board.hpp"

// A firmware build's ctest sets VERP_TEST_BOARD and VERP_TEST_TICKS.
namespace verp::test {
namespace {

using dxl::controller::SelfTest;
using dxl::controller::StartFault;

std::string test_board() {
  const char* board = std::getenv("VERP_TEST_BOARD");
  return board == nullptr ? "" : board;
}

std::uint32_t test_ticks() {
  const char* ticks = std::getenv("VERP_TEST_TICKS");
  return ticks == nullptr ? 0 : static_cast<std::uint32_t>(std::strtoul(ticks, nullptr, 10));
}

TEST(SerialLoop, AnswersItsOperatorAsDevice200) {
  SerialBoard board(test_board(), params_image(load_robot("generic21")));
  const auto identity = board.operator_port().ping(dxl::controller::kDefaultId);
  ASSERT_TRUE(identity.has_value()) << board.described("no answer to a ping");
  EXPECT_EQ(identity->model, dxl::controller::kModel);
  EXPECT_EQ(board.read("self_test"), static_cast<std::uint64_t>(SelfTest::kPassed));
  EXPECT_EQ(board.read("joint_count"), 21u);
  EXPECT_EQ(board.read("crash_count"), 0u);
  EXPECT_EQ(board.read("start_fault"), 0u);
  EXPECT_EQ(board.read("clock_source"),
            static_cast<std::uint64_t>(dxl::controller::ClockSource::kAbsent));
  EXPECT_EQ(board.read("torque_enable"), 0u);
}

TEST(SerialLoop, TellsItsOperatorWhyItRefusesTorque) {
  SerialBoard board(test_board(), {});
  ASSERT_TRUE(board.operator_port().ping(dxl::controller::kDefaultId).has_value());
  EXPECT_EQ(board.read("self_test"), static_cast<std::uint64_t>(SelfTest::kImage));
  EXPECT_EQ(board.read("start_fault"), static_cast<std::uint64_t>(StartFault::kSelfTest));
  EXPECT_EQ(board.read("joint_count"), 0u);
  board.write("request", static_cast<std::int64_t>(Request::kRelax));
  board.write("request", static_cast<std::int64_t>(Request::kStand));
  EXPECT_EQ(board.read("tick"), 0u) << "the loop must not run";
  EXPECT_EQ(board.read("torque_enable"), 0u);
}

// The board does not retry by endless resets.
TEST(SerialLoop, TellsItsOperatorThatTheServoPortDoesNotOpen) {
  Robot robot = load_robot("generic21");
  robot.entity.baud = 50'000'000;  // no divider gives this
  SerialBoard board(test_board(), params_image(robot));
  ASSERT_TRUE(board.operator_port().ping(dxl::controller::kDefaultId).has_value());
  EXPECT_EQ(board.read("self_test"), static_cast<std::uint64_t>(SelfTest::kPassed));
  EXPECT_EQ(board.read("start_fault"), static_cast<std::uint64_t>(StartFault::kServoPort));
  board.write("request", static_cast<std::int64_t>(Request::kRelax));
  board.write("request", static_cast<std::int64_t>(Request::kStand));
  EXPECT_EQ(board.read("tick"), 0u) << "the loop must not run";
  EXPECT_EQ(board.read("torque_enable"), 0u);
}

TEST(SerialLoop, WalksTheSameBitsThroughItsUsartsAndInThisProcess) {
  const std::uint32_t ticks = test_ticks();
  ASSERT_GT(ticks, 0u) << "set VERP_TEST_TICKS";
  const Robot robot = load_robot("generic21");
  const TwinRun here = run_here(robot, ticks, false);
  ASSERT_EQ(here.records.size(), ticks);
  SerialBoard board(test_board(), params_image(robot));
  ASSERT_TRUE(board.operator_port().ping(dxl::controller::kDefaultId).has_value());
  const SerialRun there = run_over_serial(board, robot, ticks);
  EXPECT_EQ(there.difference, "");
  ASSERT_EQ(there.twin.records.size(), ticks);
  for (std::uint32_t i = 0; i < ticks; ++i) {
    ASSERT_EQ(here.records[i].digest.chain, there.twin.records[i].digest.chain) << "tick " << i;
  }
  EXPECT_EQ(there.digest, here.records.back().digest.chain) << "as the controller itself tells it";
  EXPECT_EQ(there.tick, here.records.back().inputs.tick);
  EXPECT_EQ(there.twin.distance_m, here.distance_m);
  EXPECT_FALSE(there.twin.fallen);
  EXPECT_GT(there.twin.distance_m, 0.2) << "it should have walked";
  std::printf("%s: %u ticks at %.0f ticks/s\n", test_board().c_str(), ticks, there.ticks_per_s);
}

// Its Params, not its build, choose the servos' protocol.
TEST(SerialLoop, StandsOnFeetechServosWithTheSameBits) {
  constexpr std::uint32_t kTicks = 120;
  const Robot robot = load_robot("generic21", "feetech");
  const TwinRun here = run_here(robot, kTicks, false);
  ASSERT_EQ(here.modes.back(), safety::Mode::kStanding);
  SerialBoard board(test_board(), params_image(robot));
  ASSERT_TRUE(board.operator_port().ping(dxl::controller::kDefaultId).has_value());
  EXPECT_EQ(board.read("start_fault"), 0u);
  const SerialRun there = run_over_serial(board, robot, kTicks);
  EXPECT_EQ(there.difference, "");
  EXPECT_EQ(there.digest, here.records.back().digest.chain);
  EXPECT_EQ(there.twin.distance_m, here.distance_m);
}

TEST(SerialLoop, GetsUpByTheActionsInItsFlash) {
  const Robot robot = load_robot("generic21");
  const Script script = fall_script(robot);
  const TwinRun here = run_here(robot, script);
  ASSERT_EQ(modes_text(here.modes), modes_text({std::begin(kFallModes), std::end(kFallModes)}));
  SerialBoard board(test_board(), params_image(robot), actions_image(robot));
  ASSERT_TRUE(board.operator_port().ping(dxl::controller::kDefaultId).has_value());
  EXPECT_GT(board.read("action_count"), 0u);
  EXPECT_EQ(board.read("action_fault"), 0u);
  const SerialRun there = run_over_serial(board, robot, script);
  EXPECT_EQ(there.difference, "");
  ASSERT_EQ(there.twin.records.size(), here.records.size());
  for (std::size_t i = 0; i < here.records.size(); ++i) {
    ASSERT_EQ(here.records[i].digest.chain, there.twin.records[i].digest.chain) << "tick " << i;
  }
  EXPECT_EQ(there.digest, here.records.back().digest.chain) << "as the controller itself tells it";
  std::printf("%s: %zu ticks at %.0f ticks/s\n", test_board().c_str(), here.records.size(),
              there.ticks_per_s);
}

TEST(SerialLoop, TellsItsOperatorWhyItsActionsDoNotCount) {
  const Robot robot = load_robot("generic21"), other = load_robot("op3");
  const auto fault_of = [&](const std::vector<std::uint8_t>& actions) {
    SerialBoard board(test_board(), params_image(robot), actions);
    EXPECT_TRUE(board.operator_port().ping(dxl::controller::kDefaultId).has_value());
    EXPECT_EQ(board.read("action_count"), 0u);
    EXPECT_EQ(board.read("start_fault"), 0u);
    board.write("request", static_cast<std::int64_t>(Request::kRelax));
    EXPECT_THROW(board.write("action_request", 1), bus::DeviceError);
    return static_cast<action::KeptFault>(board.read("action_fault"));
  };
  std::vector<std::uint8_t> image = actions_image(robot);
  EXPECT_EQ(fault_of(std::vector<std::uint8_t>(64 * 1024, 0xFF)), action::KeptFault::kNone);
  EXPECT_EQ(fault_of(actions_image(other)), action::KeptFault::kOtherRobot);
  image[image.size() / 2] ^= 1;
  EXPECT_EQ(fault_of(image), action::KeptFault::kDamaged);
  EXPECT_EQ(fault_of(params_image(robot)), action::KeptFault::kNotALibrary);
}

std::vector<std::uint8_t> actions_in_force(SerialBoard& board) {
  board.write("window_kind", 2);
  std::vector<std::uint8_t> bytes;
  for (const std::uint64_t size = board.read("window_size"); bytes.size() < size;) {
    board.write("window_offset", static_cast<std::int64_t>(bytes.size()));
    const auto block = board.operator_port().read(
        dxl::controller::kDefaultId, dxl::controller::find("window_data")->address,
        static_cast<std::uint16_t>(
            std::min<std::uint64_t>(dxl::controller::kWindowBytes, size - bytes.size())));
    bytes.insert(bytes.end(), block.begin(), block.end());
  }
  return bytes;
}

// Only a debugger (write_flash) can write the emulated flash.
TEST(SerialLoop, SaysWhyItTakesNoActionsAndKeepsThoseThatItHas) {
  const Robot robot = load_robot("generic21");
  const std::vector<std::uint8_t> image = actions_image(robot);
  SerialBoard board(test_board(), params_image(robot), image);
  const auto count = static_cast<int>(board.read("action_count"));
  EXPECT_EQ(actions_in_force(board), image);
  const auto port = action::serial_action_port(board.operator_port(), dxl::controller::kDefaultId);
  const auto refusal = [&](const std::vector<std::uint8_t>& bytes, const char* name) {
    try {
      action::send_actions(*port, bytes, {.robot = name, .actions = count});
      return std::string();
    } catch (const bus::DeviceError& error) {
      return std::string(error.what());
    }
  };
  const auto has = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  EXPECT_PRED2(has, refusal(image, "op3"), "its robot is generic21");
  EXPECT_PRED2(has, refusal(std::vector<std::uint8_t>(64 * 1024), "generic21"), "no room");
  EXPECT_PRED2(has, refusal(image, "generic21"), "its flash did not keep a block");
  EXPECT_EQ(board.read("window_state"), 3u);
  EXPECT_EQ(actions_in_force(board), image);
  EXPECT_EQ(static_cast<int>(board.read("action_count")), count);
  EXPECT_EQ(board.read("start_fault"), 0u);
}

/// Longer than a twin may be silent.
void wait_for_no_torque(SerialBoard& board) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (board.read("torque_enable") != 0 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

TEST(SerialLoop, UnlocksItsOperatorsDeskWhileTheTwinIsSilentAndGoesOnWithTheSameBits) {
  constexpr std::uint32_t kTicks = 400, kPause = 300;  // it stands up
  const Robot robot = load_robot("generic21");
  const TwinRun here = run_here(robot, kTicks, false);
  SerialBoard board(test_board(), params_image(robot));
  ASSERT_TRUE(board.operator_port().ping(dxl::controller::kDefaultId).has_value());
  const std::int64_t source = static_cast<std::int64_t>(dxl::controller::ImuSource::kBus);
  SerialTrouble trouble;
  trouble.pause_before = kPause;
  trouble.pause = [&] {
    EXPECT_EQ(board.read("torque_enable"), 1u);
    EXPECT_THROW(board.write("imu_source", source), bus::DeviceError);
    wait_for_no_torque(board);
    EXPECT_EQ(board.read("torque_enable"), 0u) << "nobody could hold it";
    EXPECT_NO_THROW(board.write("imu_source", source));
    EXPECT_LT(board.read("tick"), kPause) << "the loop stands, and lives";
  };
  const SerialRun there = run_over_serial(board, robot, kTicks, trouble);
  EXPECT_EQ(there.difference, "");
  EXPECT_EQ(there.digest, here.records.back().digest.chain);
  EXPECT_EQ(there.lockstep.greetings, 1u);
  wait_for_no_torque(board);
  EXPECT_EQ(board.read("torque_enable"), 0u);
}

}  // namespace
}  // namespace verp::test
