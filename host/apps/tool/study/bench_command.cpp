#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/control/state.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/apps/tool/study/bench_report.hpp"
#include "host/apps/tool/study/commands.hpp"
#include "host/boards/board/cost_promise.hpp"
#include "host/boards/board/emulated_board.hpp"
#include "host/boards/board/temporary_directory.hpp"
#include "host/os/files/places.hpp"
#include "host/os/files/shell_line.hpp"
#include "host/os/files/whole.hpp"
#include "host/os/process/child.hpp"

/// Runs the programs of tests/bench and compares with the promised limits.
namespace verp::tool {
namespace {

/// Adds the row of one line of language_bench, with its promise.
void add_language_row(const cli::Json& line, std::vector<BenchRow>& rows) {
  struct Language {
    const char* what;
    double at_least;  ///< ticks per second; 0: no limit
  };
  static const std::map<std::string, Language> kLanguages = {
      {"cpp", {"C++, libverp in the process", 0}},
      {"csharp", {"C#, mono", 0}},
      {"python", {"Python", 5000}},
      {"octave", {"Octave", 2000}},
      {"external", {"another process, over a Unix socket", 2000}}};
  const std::string name = line.at("language");
  const Language& language = kLanguages.at(name);
  BenchRow row{.name = name + "_ticks_per_s",
               .where = "languages",
               .what = language.what,
               .unit = "ticks/s",
               .bar = language.at_least > 0 ? Bar::kAtLeast : Bar::kNone,
               .limit = language.at_least};
  row.missing = line.value("missing", "");
  row.failed = line.value("failed", "");
  if (row.measured()) {
    const std::vector<double> values = line.at("ticks_per_s");
    row.value = median(values);
    row.least = *std::min_element(values.begin(), values.end());
    row.most = *std::max_element(values.begin(), values.end());
  }
  rows.push_back(std::move(row));
}

constexpr double kMostTick_us = 3;
constexpr double kLeastTimesFasterThanKdl = 100;
/// For several minutes of walking where CAN sockets exist.
constexpr const char* kWithCan = " --timeout 600 --memory 1500M ";
constexpr const char* kTiming = " --benchmark_format=json --benchmark_min_time=0.1";

struct BenchOptions {
  bool json = false, pc = false;
  int repetitions = 7;
  std::string only;  ///< "languages", "frames" or "window"
};

/// Runs a program of this build tree behind `where`; `take` gets each line of stdout. Throws
/// ToolError with its last output.
template <class Take>
void run_program(const std::string& program, const std::string& arguments, Take take,
                 const std::string& where = "") {
  const std::string path = (files::build_dir() / program).string();
  if (!std::filesystem::exists(path)) {
    throw cli::ToolError(cli::kNoDevice, path +
                                             ": not built; run ./verp bench, which installs Google "
                                             "Benchmark and KDL and builds it");
  }
  const board::TemporaryDirectory scratch;
  const auto errors = scratch.path() / "errors";
  const std::string command =
      where + files::shell_word(path) + arguments + " 2>" + files::shell_word(errors.string());
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw cli::ToolError(cli::kNoDevice, path + ": cannot be started");
  std::string line;
  for (int c; (c = std::fgetc(pipe)) != EOF;) {
    line += static_cast<char>(c);
    if (c == '\n') take(line), line.clear();
  }
  const int status = pclose(pipe);
  if (cli::interrupted()) throw cli::ToolError(cli::kRunFailed, "verp bench: interrupted");
  if (status == 0) return;
  const bool told = WIFEXITED(status) && WEXITSTATUS(status) <= cli::kNoDevice;
  throw cli::ToolError(
      told ? static_cast<cli::ExitStatus>(WEXITSTATUS(status)) : cli::kRunFailed,
      program + " failed: " + process::last_line(files::read(errors).value_or("")));
}

using Samples = std::map<std::string, std::vector<double>>;

/// Adds CPU times in ns and counters of one run of a Google Benchmark program.
void sample(const std::string& program, const std::string& folder, Samples& samples) {
  std::string text;
  run_program(program, " " + files::shell_word(folder) + kTiming,
              [&](const std::string& l) { text += l; });
  const cli::Json result = cli::Json::parse(text);
  for (const cli::Json& benchmark : result.at("benchmarks")) {
    const std::string name = benchmark.at("name");
    samples[name].push_back(benchmark.at("cpu_time"));
    for (const char* counter : {"is_newton", "apart_rad", "apart_m", "iterations", "targets"}) {
      if (benchmark.contains(counter)) {
        samples[name + "." + counter].push_back(benchmark[counter]);
      }
    }
  }
}

BenchRow timed(const char* name, const char* what, const char* unit, std::vector<double> values,
               Bar bar, double limit) {
  BenchRow row{.name = name, .where = "pc", .what = what, .unit = unit, .bar = bar, .limit = limit};
  row.value = median(values);
  row.least = *std::min_element(values.begin(), values.end());
  row.most = *std::max_element(values.begin(), values.end());
  return row;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

void add_pc_rows(const Samples& samples, std::vector<BenchRow>& rows) {
  const std::vector<double>&ours = samples.at("leg_ik"), &kdl = samples.at("kdl_leg_ik");
  std::vector<double> times;  // the two ran in succession
  for (std::size_t n = 0; n < ours.size(); ++n) times.push_back(kdl.at(n) / ours[n]);
  rows.push_back(timed("tick_us", "one tick, digest included", "µs",
                       scaled(samples.at("tick"), 1e-3), Bar::kAtMost, kMostTick_us));
  rows.push_back(timed("digest_us", "the digest in it", "µs", scaled(samples.at("digest"), 1e-3),
                       Bar::kNone, 0));
  rows.push_back(
      timed("leg_ik_us", "leg IK, closed form", "µs", scaled(ours, 1e-3), Bar::kNone, 0));
  rows.push_back(timed("kdl_leg_ik_us", "the same by KDL's fastest, warm", "µs", scaled(kdl, 1e-3),
                       Bar::kNone, 0));
  rows.push_back(timed("leg_ik_times_faster", "so ours is faster by", "times", times, Bar::kAtLeast,
                       kLeastTimesFasterThanKdl));
  rows.push_back(timed("body_kinematics_us", "all links' poses, centre of mass", "µs",
                       scaled(samples.at("body_kinematics"), 1e-3), Bar::kNone, 0));
  rows.push_back({.name = "state_bytes",
                  .where = "pc",
                  .what = "hashed state",
                  .unit = "bytes",
                  .value = sizeof(State),
                  .bar = Bar::kAtMost,
                  .limit = board::kMostStateBytes,
                  .exact = true});
}

/// Adds the rows of a line of target_bench: a board's exact cost, or its link's speed.
void add_board_rows(const cli::Json& line, std::vector<BenchRow>& rows, cli::Json& headings) {
  const std::string where = line.at("board");
  const Bar promised = where == board::kPromisedBoard ? Bar::kAtMost : Bar::kNone;
  const auto add = [&](const char* name, const char* what, const char* unit, Bar bar, double limit,
                       bool exact) {
    rows.push_back({.name = name,
                    .where = where,
                    .what = what,
                    .unit = unit,
                    .value = line.at(name),
                    .bar = bar,
                    .limit = limit,
                    .exact = exact});
  };
  if (line.contains("link_ticks_per_s")) {
    add("link_ticks_per_s", "ticks a second of the link alone", "",
        promised == Bar::kNone ? Bar::kNone : Bar::kAtLeast, board::kLeastLinkTicksPerS, false);
    return;
  }
  if (line.contains("can_ticks_per_s")) {
    headings[where] = fmt::format("{}, {} ticks", line.at("core").get<std::string>(),
                                  line.at("ticks").get<std::uint64_t>());
    add("can_ticks_per_s", "ticks a second over CAN, without physics", "", Bar::kAtLeast,
        board::kLeastCanTicksPerS, false);
    add("can_frames_per_tick", "frames on vcan0 of a tick, the clock's included", "", Bar::kNone, 0,
        true);
    return;
  }
  headings[where] = fmt::format("{}, {} ticks", line.at("core").get<std::string>(),
                                line.at("ticks").get<std::uint64_t>());
  add("instructions_average", "instructions of a tick, average", "", promised,
      board::kMostInstructions, true);
  add("instructions_worst", "instructions of the worst tick", "", promised,
      board::kMostInstructionsWorst, true);
  add("digest_worst", "instructions of the digest in it", "", promised,
      board::kMostInstructionsDigest, true);
  add("stack_static_bytes", "stack, bound by analysis", "bytes", promised, board::kMostStackBytes,
      true);
  add("stack_measured_bytes", "stack, as deep as it went", "bytes", Bar::kNone, 0, true);
  add("image_bytes", "code and constants of the replay image", "bytes", Bar::kNone, 0, true);
}

void add_picture_rows(const cli::Json& line, std::vector<BenchRow>& rows) {
  const int robots = line.at("robots");
  const std::string kind = line.value("antialias", false) ? "antialiased" : "as a window draws it";
  const bool coarse = line.value("step_us", 1000) != 1000;
  const std::string of = fmt::format("{} robot{}{}", robots, robots == 1 ? "" : "s",
                                     coarse ? ", --physics-step 2" : "");
  const auto add = [&](const char* name, const std::string& what, const char* unit,
                       std::optional<double> at_least = {}) {
    rows.push_back({.name = fmt::format("{}_{}{}", name, robots, coarse ? "_2ms" : ""),
                    .where = "pc",
                    .what = what,
                    .unit = unit,
                    .value = line.at(name),
                    .bar = at_least ? Bar::kAtLeast : Bar::kNone,
                    .limit = at_least.value_or(0)});
  };
  if (line.at("what") == "frames") {
    add("cpu_ms", fmt::format("a picture of {}, {}, CPU time", of, kind), "ms");
    return;
  }
  if (line.at("what") == "camera") {
    const std::string which = line.at("kind");
    add("cpu_ms", fmt::format("a camera's of 320x240, {}, CPU time", which), "ms");
    add("apart", fmt::format("  its pixels from those of 64 samples, rms"), "of 255");
    return;
  }
  // Limits for two idle cores with software rendering.
  add("frames_per_s", fmt::format("the window with {}", of), "1/s", robots == 1 ? 20 : 10);
  add("real_time_factor", "the twin beside it, of real time", "times", 0.99);
  add("cores", "cores busy with both", "");
}

void run_languages(int repetitions, std::vector<BenchRow>& rows, cli::Json& headings) {
  headings["languages"] = fmt::format(
      "the controller stepped by other programs, a call a tick, without physics; CPU time, of two "
      "processes the clock's; median of {}",
      repetitions);
  run_program("bench/language_bench", fmt::format(" {}", repetitions),
              [&](const std::string& text) { add_language_row(cli::Json::parse(text), rows); });
}

int tell(const BenchOptions& options, const std::vector<BenchRow>& rows,
         const cli::Json& headings) {
  cli::print_answer(options.json, {{"results", bench_json(rows)}}, bench_table(rows, headings));
  if (bench_held(rows)) return cli::kGood;
  cli::complain("verp bench: a measurement failed; see FAILED");
  return cli::kRunFailed;
}

int run_languages_alone(const BenchOptions& options) {
  std::vector<BenchRow> rows;
  cli::Json headings = cli::Json::object();
  cli::Progress progress(!options.json);
  progress.show(0, "stepping the controller from other languages");
  run_languages(options.repetitions, rows, headings);
  progress.clear();
  return tell(options, rows, headings);
}

int run_pictures(const BenchOptions& options) {
  std::vector<BenchRow> rows;
  const bool needs_display = options.only == "window" && std::getenv("DISPLAY") == nullptr;
  cli::Progress progress(!options.json);
  progress.show(0, "drawing");
  run_program(
      "bench/window_bench", " " + options.only,
      [&](const std::string& line) { add_picture_rows(cli::Json::parse(line), rows); },
      needs_display ? "xvfb-run -a -s '-screen 0 1280x800x24' " : "");
  progress.clear();
  return tell(options, rows, {{"pc", "pictures of 640x480, drawn here"}});
}

int run_bench(const BenchOptions& options) {
  if (options.only == "languages") return run_languages_alone(options);
  if (!options.only.empty()) return run_pictures(options);
  std::size_t boards = 0;
  if (!options.pc) {
    for (const auto& each : board::emulated_boards()) {
      if (each.measured) firmware_image(each, "replay"), boards += 2;
      if (!each.can.empty()) firmware_image(each, "loop"), ++boards;
    }
  }
  const board::TemporaryDirectory folder;
  cli::Progress progress(!options.json);
  const double steps = options.repetitions + 1 + static_cast<double>(boards);
  std::vector<BenchRow> rows;
  cli::Json headings = {
      {"pc", fmt::format("CPU time here, generic21 walking, median of {}", options.repetitions)}};
  Samples samples;
  for (int n = 0; n < options.repetitions; ++n) {
    progress.show(n / steps, "timing on this PC");
    sample("bench/bench_core", folder.path().string(), samples);
    sample("bench/bench_peers", folder.path().string(), samples);
  }
  add_pc_rows(samples, rows);
  progress.show(options.repetitions / steps, "stepping the controller from other languages");
  run_languages(options.repetitions, rows, headings);
  if (!options.pc) {
    double done = options.repetitions + 1;
    progress.show(done / steps, "counting instructions on emulated boards");
    run_program("target/target_bench", "", [&](const std::string& line) {
      add_board_rows(cli::Json::parse(line), rows, headings);
      progress.show(++done / steps, "counting instructions on emulated boards");
    });
    progress.show(done / steps, "walking over emulated CAN");
    run_program(
        "target/can_bench", "",
        [&](const std::string& line) {
          add_board_rows(cli::Json::parse(line), rows, headings);
          progress.show(++done / steps, "walking over emulated CAN");
        },
        files::shell_word((files::source_dir() / "tests/support/with-can").string()) + kWithCan);
  }
  progress.clear();
  const bool good = bench_held(rows);
  const bool newton = samples.at("kdl_leg_ik.is_newton").front() != 0;
  const cli::Json kdl = {{"solver", newton ? "NR with WDLS" : "LMA"},
                         {"targets", samples.at("kdl_leg_ik.targets").front()},
                         {"iterations_mean", samples.at("kdl_leg_ik.iterations").front()},
                         {"apart_rad", samples.at("kdl_leg_ik.apart_rad").front()},
                         {"apart_m", samples.at("kdl_leg_ik.apart_m").front()}};
  cli::print_answer(
      options.json,
      {{"kept", good},
       {"repetitions", options.repetitions},
       {"kdl_check", kdl},
       {"results", bench_json(rows)}},
      fmt::format("{}KDL's {} gave our angles within {:.1f} mrad on {} targets, in {:.1f} "
                  "iterations each.\n",
                  bench_table(rows, headings), kdl["solver"].get<std::string>(),
                  1e3 * kdl["apart_rad"].get<double>(), kdl["targets"].get<double>(),
                  kdl["iterations_mean"].get<double>()));
  if (!good)
    cli::complain(
        "verp bench: a promise on counts is not kept, or a measurement failed; see MISSED, FAILED");
  return good ? cli::kGood : cli::kRunFailed;
}

}  // namespace

cli::Subcommand add_bench(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "bench");
  auto options = std::make_shared<BenchOptions>();
  app->add_flag("--pc", options->pc, "this PC only: needs no cross compiler");
  app->add_option("--repetitions", options->repetitions, "runs of each timing on this PC")
      ->check(cli::whole_number_between(1, 100))
      ->capture_default_str();
  app->add_option("--only", options->only,
                  "languages: how fast other languages and processes step the controller; or what "
                  "pictures cost: frames, by the renderer alone; window, with the twin in real "
                  "time beside it")
      ->check(CLI::IsMember({"languages", "frames", "window"}));
  cli::add_json_flag(*app, options->json);
  return {app, [options] {
            cli::catch_interrupts();
            return run_bench(*options);
          }};
}

}  // namespace verp::tool
