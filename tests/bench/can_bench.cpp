#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "host/boards/board/emulated_board.hpp"
#include "host/twin/can/virtual_can.hpp"
#include "tests/hil/level_plant.hpp"
#include "tests/target/can_run.hpp"

/// can_bench [--ticks N] [BOARD...]: speed of the loop between an emulated board (default: each
/// with CAN) and a robot on vcan0. One JSON line each. Run it inside tests/support/with-can.
namespace {

constexpr std::uint32_t kTicks = 1900;  // stands up, walks ten seconds, stops

int run(std::vector<std::string> boards, std::uint32_t ticks) {
  if (boards.empty()) {
    for (const auto& board : verp::board::emulated_boards()) {
      if (!board.can.empty()) boards.emplace_back(board.name);
    }
  }
  const verp::test::Robot robot = verp::test::load_robot("generic21", "can");
  for (const std::string& board : boards) {
    verp::test::LevelPlant plant(robot.params);
    verp::can::VirtualCan bus(robot.params, plant);
    const verp::test::CanRun run = verp::test::run_over_can(
        board, robot.params, bus, verp::test::walk_script(robot.params, ticks));
    fmt::print(
        R"({{"board": "{}", "core": "{}", "ticks": {}, "can_ticks_per_s": {:.1f}, "can_frames_per_tick": {:.1f}, "can_answers_repeated": {}}})"
        "\n",
        board, verp::board::find_emulated_board(board).core, run.records.size(), run.ticks_per_s,
        run.frames_per_tick, run.counters.repeats);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t ticks = kTicks;
  std::vector<std::string> boards(argv + 1, argv + argc);
  try {
    if (boards.size() > 1 && boards[0] == "--ticks") {
      ticks = static_cast<std::uint32_t>(std::stoul(boards[1]));
      boards.erase(boards.begin(), boards.begin() + 2);
    }
    return run(boards, ticks);
  } catch (const std::exception& error) {
    fmt::print(stderr, "can_bench: {}\n", error.what());
    return 3;
  }
}
