#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "host/boards/board/cost_promise.hpp"
#include "host/boards/board/emulated_board.hpp"
#include "tests/bench/link_speed.hpp"
#include "tests/bench/target_cost.hpp"
#include "tests/target/twin_run.hpp"

/// target_bench [--check|--profile] [BOARD...]: a walking generic21's exact cost of a tick on each
/// emulated board, and its link's speed. One JSON line each. --check: exit 1 if a promise is
/// broken. --profile: where the instructions go.
namespace {

constexpr std::uint32_t kTicks = 3600;  // 36 s at 10 ms: stands up, six walks, stops
constexpr std::uint32_t kLinkTicks = 20000;
constexpr int kLinkAttempts = 3;  // the best counts

bool keeps(const char* what, double value, double least, double most) {
  const bool good = value >= least && value <= most;
  if (!good) {
    fmt::print(stderr, "target_bench: {} is {:.0f}, promised {:.0f} to {:.0f}\n", what, value,
               least, most);
  }
  return good;
}

bool bench_cost(const std::string& board, const verp::Params& params,
                const std::vector<verp::Inputs>& inputs) {
  const verp::board::TargetCost cost = verp::board::measure_target(board, params, inputs);
  fmt::print("{}\n", verp::board::to_json(board, cost));
  if (board != verp::board::kPromisedBoard) return true;
  const bool good[] = {
      keeps("instructions a tick on average", cost.average, 0, verp::board::kMostInstructions),
      keeps("instructions of the worst tick", static_cast<double>(cost.worst), 0,
            verp::board::kMostInstructionsWorst),
      keeps("instructions of the digest", static_cast<double>(cost.digest_worst), 0,
            verp::board::kMostInstructionsDigest),
      keeps("stack by static analysis, bytes", cost.stack_static_bytes, 0,
            verp::board::kMostStackBytes)};
  return good[0] && good[1] && good[2] && good[3];
}

void show_profile(const std::string& board, const verp::Params& params,
                  const std::vector<verp::Inputs>& inputs) {
  fmt::print("{}\n{:>10} {:>10} {:>8}  a tick, callees included\n", board, "average", "worst",
             "calls");
  for (const auto& f : verp::board::profile_target(board, params, inputs)) {
    fmt::print("{:10.0f} {:10} {:8.2f}  {:.100}\n", f.average_a_tick, f.worst_tick, f.calls_a_tick,
               f.name);
  }
}

bool bench_link(const std::string& board, const verp::Params& params) {
  const verp::board::OneCore one_core;
  verp::board::LinkSpeed alone;
  double pipes = 0;
  for (int attempt = 0; attempt < kLinkAttempts; ++attempt) {
    const auto speed = verp::board::measure_link(board, params, kLinkTicks, false);
    if (speed.ticks_per_s > alone.ticks_per_s) alone = speed;
    pipes = std::max(pipes, verp::board::measure_pipes(2 * kLinkTicks));
  }
  const auto with_step = verp::board::measure_link(board, params, kLinkTicks / 4, true);
  fmt::print(
      R"({{"board": "{}", "link_ticks_per_s": {:.0f}, "link_round_trips_per_s": {:.0f}, "pipe_round_trips_per_s": {:.0f}, "link_ticks_per_s_with_step": {:.0f}}})"
      "\n",
      board, alone.ticks_per_s, alone.round_trips_per_s, pipes, with_step.ticks_per_s);
  return board != verp::board::kPromisedBoard ||
         keeps("percent of two processes' round trips over the link",
               100 * alone.round_trips_per_s / pipes, verp::board::kLeastLinkPercent, 1e9);
}

enum class Task { kBench, kCheck, kProfile };

int run(std::vector<std::string> boards, Task task) {
  if (boards.empty()) {
    for (const auto& board : verp::board::emulated_boards()) {
      if (board.measured) boards.emplace_back(board.name);
    }
  }
  const verp::test::Robot robot = verp::test::load_robot("generic21");
  const verp::test::TwinRun walk = verp::test::run_here(robot, kTicks, true);
  std::vector<verp::Inputs> inputs;
  for (const verp::TickRecord& record : walk.records) inputs.push_back(record.inputs);
  bool good = inputs.size() == kTicks;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  for (const std::string& board : boards) {
    if (task == Task::kProfile) {
      show_profile(board, robot.params, inputs);
      continue;
    }
    good = bench_cost(board, robot.params, inputs) && good;
    good = bench_link(board, robot.params) && good;
  }
  return good || task != Task::kCheck ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Task task = Task::kBench;
  std::vector<std::string> boards;
  for (const std::string_view word : std::vector<std::string_view>(argv + 1, argv + argc)) {
    if (word == "--check") {
      task = Task::kCheck;
    } else if (word == "--profile") {
      task = Task::kProfile;
    } else {
      boards.emplace_back(word);
    }
  }
  try {
    return run(boards, task);
  } catch (const std::exception& error) {
    fmt::print(stderr, "target_bench: {}\n", error.what());
    return 3;
  }
}
