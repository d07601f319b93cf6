#include "tests/bench/target_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "host/boards/board/board_error.hpp"
#include "host/boards/board/emulated_board.hpp"
#include "host/boards/board/replay_on_target.hpp"
#include "host/boards/board/temporary_directory.hpp"
#include "host/os/files/places.hpp"

namespace verp::board {
namespace {

constexpr const char* kStep = "verp::step";
constexpr const char* kDigest = "verp::digest_state";

/// Throws BoardError with `remedy` if it fails.
std::string output_of(const std::string& command, const std::string& remedy) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> buffer;
  while (pipe && fgets(buffer.data(), buffer.size(), pipe.get()) != nullptr) text += buffer.data();
  if (text.empty()) throw BoardError(command + ": gave nothing; " + remedy);
  return text;
}

/// From lines "ADDRESS T NAME(PARAMETERS)".
std::string address_of(const std::string& symbols, const std::string& function) {
  const std::size_t at = symbols.find(" T " + function + "(");
  if (at == std::string::npos || at < 8) {
    throw BoardError("the image has no function " + function + "; it must not be inlined");
  }
  return symbols.substr(at - 8, 8);
}

struct Count {
  std::string name;
  std::uint64_t calls = 0, sum = 0, least = 0, most = 0, most_at = 0, most_in_step = 0;
};

/// By instruction_count.c; step() comes first.
std::vector<Count> read_counts(const std::filesystem::path& path) {
  std::vector<Count> counts;
  std::ifstream file(path);
  for (Count c;
       file >> c.name >> c.calls >> c.sum >> c.least >> c.most >> c.most_at >> c.most_in_step;) {
    counts.push_back(c);
  }
  if (counts.empty() || counts.front().calls == 0) {
    throw BoardError("the instruction counter saw no tick; rebuild the image");
  }
  return counts;
}

std::string plugin_option(const std::filesystem::path& out) {
  return (files::build_dir() / "tests/bench/libverp_instruction_count.so").string() +
         ",out=" + out.string();
}

std::string symbols_of(const std::string& image) {
  return output_of("arm-none-eabi-nm -C " + image, "install binutils-arm-none-eabi");
}

void measure_stack(const std::string& image, TargetCost& cost) {
  std::istringstream line(output_of(
      (files::source_dir() / "host/boards/board/stack_depth").string() + " " + image + " " + kStep,
      "its message above says why; perl and binutils-arm-none-eabi are needed"));
  line >> cost.stack_static_bytes;
  std::getline(line >> std::ws, cost.stack_chain);
}

std::uint32_t text_bytes(const std::string& image) {
  std::istringstream text(
      output_of("arm-none-eabi-size " + image, "install binutils-arm-none-eabi"));
  std::string heading;
  std::getline(text, heading);
  std::uint32_t bytes = 0;
  text >> bytes;
  return bytes;
}

}  // namespace

TargetCost measure_target(const std::string& board, const Params& params,
                          std::span<const Inputs> inputs) {
  const std::string image = firmware_image(find_emulated_board(board), "replay").string();
  const std::string symbols = symbols_of(image);
  const TemporaryDirectory directory;
  const auto out = directory.path() / "counts";
  TargetReplayOptions options;
  options.plugin = fmt::format("{},call=step:{},call=digest:{}", plugin_option(out),
                               address_of(symbols, kStep), address_of(symbols, kDigest));
  TargetCost cost;
  cost.stack_measured_bytes = replay_on(board, params, inputs, options).stack_bytes;

  const std::vector<Count> counts = read_counts(out);
  const Count& step = counts.at(0);
  const Count& digest = counts.at(1);
  cost.ticks = step.calls;
  cost.average = static_cast<double>(step.sum) / static_cast<double>(step.calls);
  cost.worst = step.most;
  cost.worst_tick = step.most_at;
  cost.digest_average = static_cast<double>(digest.sum) / static_cast<double>(step.calls);
  cost.digest_worst = digest.most_in_step;
  measure_stack(image, cost);
  cost.image_bytes = text_bytes(image);
  return cost;
}

std::vector<FunctionCost> profile_target(const std::string& board, const Params& params,
                                         std::span<const Inputs> inputs) {
  const std::string symbols =
      symbols_of(firmware_image(find_emulated_board(board), "replay").string());
  const TemporaryDirectory directory;
  const auto out = directory.path() / "counts";
  TargetReplayOptions options;
  options.plugin = plugin_option(out) + ",call=step:" + address_of(symbols, kStep);
  std::vector<std::string> names = {kStep};
  std::istringstream lines(symbols);
  std::string address, kind;
  for (std::string name; lines >> address >> kind && std::getline(lines >> std::ws, name);) {
    const bool is_core = name.starts_with("verp::") &&
                         name.find("::Replay<") == std::string::npos &&
                         (kind == "T" || kind == "t" || kind == "W");
    if (!is_core || name.starts_with("verp::step(") || name.starts_with("verp::hal::") ||
        name.starts_with("verp::boot::"))
      continue;
    options.plugin += fmt::format(",call={}:{}", names.size(), address);
    names.push_back(name);
  }
  replay_on(board, params, inputs, options);

  const std::vector<Count> counts = read_counts(out);
  const auto ticks = static_cast<double>(counts.front().calls);
  std::vector<FunctionCost> costs;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i].calls == 0) continue;
    costs.push_back({.name = names.at(i),
                     .calls_a_tick = static_cast<double>(counts[i].calls) / ticks,
                     .average_a_tick = static_cast<double>(counts[i].sum) / ticks,
                     .worst_tick = counts[i].most_in_step});
  }
  std::sort(costs.begin(), costs.end(), [](const FunctionCost& a, const FunctionCost& b) {
    return a.average_a_tick > b.average_a_tick;
  });
  return costs;
}

std::string to_json(const std::string& board, const TargetCost& cost) {
  return fmt::format(
      R"({{"board": "{}", "core": "{}", "ticks": {}, "instructions_average": {:.1f}, )"
      R"("instructions_worst": {}, "worst_tick": {}, "digest_average": {:.0f}, "digest_worst": {}, )"
      R"("stack_static_bytes": {}, "stack_chain": "{}", "stack_measured_bytes": {}, "image_bytes": {}}})",
      board, find_emulated_board(board).core, cost.ticks, cost.average, cost.worst, cost.worst_tick,
      cost.digest_average, cost.digest_worst, cost.stack_static_bytes, cost.stack_chain,
      cost.stack_measured_bytes, cost.image_bytes);
}

}  // namespace verp::board
