#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/apps/cli/suggest.hpp"
#include "host/apps/demos/draw.hpp"
#include "host/apps/demos/run.hpp"
#include "host/apps/tool/radio_words.hpp"
#include "host/apps/tool/study/commands.hpp"
#include "host/show/camera/drawing_program.hpp"
#include "host/study/report/files.hpp"
#include "host/study/report/gnuplot.hpp"
#include "host/study/report/report.hpp"

namespace verp::tool {
namespace {

constexpr double kLongest_s = 3600;
constexpr std::uint64_t kMostRobotsOfDemo = 16;

struct DemoWords {
  std::string name, picture, record, radio;
  std::uint64_t seed = 1;
  int robots = 0;
  double for_s = 0, physics_step_ms = 2;
  bool no_picture = false, json = false;
};

int list_demos(bool json) {
  cli::Json rows = cli::Json::array();
  std::string text;
  for (const demos::Demo& demo : demos::all_demos()) {
    rows.push_back({{"name", demo.name},
                    {"what", demo.what},
                    {"criterion", demo.criterion},
                    {"robots", demo.usual},
                    {"fewest", demo.fewest},
                    {"most", demo.most},
                    {"length_s", demo.length_s}});
    text += fmt::format("  {:<10}{} ({} robots)\n", demo.name, demo.what, demo.usual);
  }
  if (json) {
    cli::print_json({{"demos", rows}});
  } else {
    cli::answer(text + "verp demo NAME runs one\n");
  }
  return cli::kGood;
}

const demos::Demo& demo_of(const std::string& name) {
  std::vector<std::string> names;
  for (const demos::Demo& demo : demos::all_demos()) {
    if (demo.name == name) return demo;
    names.push_back(demo.name);
  }
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp demo {}: there is no such demo{}; verp demo lists "
                                   "them",
                                   name, cli::did_you_mean(name, names)));
}

/// Draws the picture; returns its path, or empty. `lost`: why writing it failed.
std::string draw(const DemoWords& words, const demos::Run& run, std::string& lost) {
  if (words.no_picture) return "";
  const std::string file = words.picture.empty() ? words.name + ".png" : words.picture;
  if (!report::gnuplot_available()) {
    cli::complain("verp demo: no picture: gnuplot is not installed (apt-get install gnuplot-nox)");
    return "";
  }
  std::string error;
  const report::Plot plot = demos::plot_of(run);
  const auto picture =
      file.ends_with(".svg") ? report::draw_svg(plot, error) : report::draw_png(plot, error);
  if (!picture) throw cli::ToolError(cli::kRunFailed, "verp demo: gnuplot: " + error);
  try {
    report::write_file(file, *picture);
  } catch (const report::ReportError& refused) {  // loses the picture, not the results
    lost = refused.what();
    return "";
  }
  return file;
}

std::string verdict_of(const demos::Run& run) {
  if (run.interrupted) return "interrupted";
  return run.verdict.failure.empty() ? "good" : run.verdict.failure;
}

std::string text_of(const demos::Run& run, const std::string& picture) {
  std::string out =
      fmt::format("{}: {}\n  {:<44}{}\n", run.demo->name, run.demo->what,
                  run.verdict.failure.empty() && !run.interrupted ? "good" : "FAILED",
                  run.verdict.failure.empty() ? run.demo->criterion : run.verdict.failure);
  const auto line = [&](const std::string& name, const std::string& value) {
    out += fmt::format("  {:<44}{}\n", name, value);
  };
  for (const demos::Fact& fact : run.verdict.facts)
    line(fact.name, fmt::format("{:.3g} {}", fact.value, fact.unit));
  std::string fates;
  for (int i = 0; i < radio::kFates; ++i) {
    fates += fmt::format("{}{} {}", i == 0 ? "" : ", ",
                         run.radio.fates[static_cast<std::size_t>(i)], radio::kFateNames[i]);
  }
  line("radio",
       fmt::format("{} messages, {} refused; {}", run.radio.sent, run.radio.refused, fates));
  line("length", fmt::format("{:.1f} s, computed in {:.1f} s", run.length_s, run.wall_s));
  for (const demos::Track& track : run.robots) {
    if (!track.trace.empty()) line(track.name, track.trace.string());
  }
  if (!picture.empty()) line("from above", picture);
  return out;
}

cli::Json json_of_run(const demos::Run& run, const DemoWords& words, const std::string& picture) {
  cli::Json facts = cli::Json::object();
  for (const demos::Fact& fact : run.verdict.facts)
    facts[fact.name] = {{"value", fact.value}, {"unit", fact.unit}};
  cli::Json robots = cli::Json::array();
  for (const demos::Track& track : run.robots) {
    cli::Json row = {{"name", track.name},
                     {"ticks", track.ticks},
                     {"digest", fmt::format("0x{:016x}", track.digest)},
                     {"touches", track.touches},
                     {"fell_s", track.fell_s ? cli::Json(*track.fell_s) : cli::Json()},
                     {"done_s", track.done_s ? cli::Json(*track.done_s) : cli::Json()}};
    if (!track.trace.empty()) row["trace"] = track.trace.string();
    robots.push_back(row);
  }
  cli::Json radio = {{"sent", run.radio.sent}, {"refused", run.radio.refused}};
  for (int i = 0; i < radio::kFates; ++i)
    radio[radio::kFateNames[i]] = run.radio.fates[static_cast<std::size_t>(i)];
  return {{"demo", run.demo->name},
          {"seed", words.seed},
          {"verdict", verdict_of(run)},
          {"facts", facts},
          {"robots", robots},
          {"radio", radio},
          {"length_s", run.length_s},
          {"wall_s", run.wall_s},
          {"picture", picture.empty() ? cli::Json() : cli::Json(picture)}};
}

demos::Options options_of(const DemoWords& words) {
  demos::Options options;
  options.robots = words.robots;
  options.for_s = words.for_s;
  options.seed = words.seed;
  options.physics_step_us = static_cast<std::uint32_t>(std::lround(1e3 * words.physics_step_ms));
  options.radio = radio_of("verp demo", words.radio);
  options.record = words.record;
  options.metadata = {{"demo", words.name}, {"radio", words.radio}};
  options.interrupted = cli::interrupted;
  return options;
}

/// Refuses a bad file before the demo, which takes a minute.
void check_picture(const std::string& file) {
  if (file.empty()) return;
  if (!file.ends_with(".png") && !file.ends_with(".svg"))
    throw cli::ToolError(cli::kBadInput,
                         "verp demo: --picture " + file + ": pictures end in .png or .svg");
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("verp demo: --picture {}: there is no folder {}", file, folder.string()));
  }
}

demos::Run run_it(const demos::Demo& demo, const demos::Options& options) {
  try {
    return demos::run(demo, options);
  } catch (const std::invalid_argument& error) {
    throw cli::ToolError(cli::kBadInput, fmt::format("verp demo {}", error.what()));
  } catch (const camera::CameraError& error) {
    throw cli::ToolError(cli::kNoDevice, error.what());
  }
}

int run_demo(const DemoWords& words) {
  if (words.name.empty()) return list_demos(words.json);
  const demos::Demo& demo = demo_of(words.name);
  check_picture(words.picture);
  demos::Options options = options_of(words);
  cli::catch_interrupts();
  cli::Progress progress(!words.json);
  options.went_on = [&](double share) { progress.show(share, demo.name); };
  const demos::Run run = run_it(demo, options);
  progress.clear();
  std::string lost;
  const std::string picture = draw(words, run, lost);
  cli::Json json = json_of_run(run, words, picture);
  if (!lost.empty()) json["lost"] = {lost};
  cli::print_answer(words.json, json, text_of(run, picture));
  if (!lost.empty()) cli::complain("verp demo: " + lost);
  bool good = run.verdict.failure.empty() && !run.interrupted;
  for (const demos::Track& track : run.robots) {
    if (track.trace_failure.empty()) continue;
    cli::complain(fmt::format("verp demo: {}: {}", track.trace.string(), track.trace_failure));
    good = false;
  }
  if (!good) cli::complain(fmt::format("verp demo {}: {}", demo.name, verdict_of(run)));
  return good && lost.empty() ? cli::kGood : cli::status_if_interrupted(cli::kRunFailed);
}

}  // namespace

cli::Subcommand add_demo(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "demo");
  auto words = std::make_shared<DemoWords>();
  app->add_option("NAME", words->name, "which");
  app->add_option("--robots", words->robots, "how many; default: the demo's own")
      ->check(cli::whole_number_between(1, kMostRobotsOfDemo));
  app->add_option("--for", words->for_s, "at most so long, s; default: the demo's own")
      ->check(cli::number_between(1, kLongest_s, "s"));
  app->add_option("--seed", words->seed,
                  "of the first robot and the radio; other robots have the next ones")
      ->check(cli::whole_number_between(0, std::numeric_limits<std::uint64_t>::max()))
      ->capture_default_str();
  app->add_option("--radio", words->radio, kRadioWords);
  app->add_option("--physics-step", words->physics_step_ms, "of the twin, ms")
      ->check(cli::number_between(0.5, 2, "ms"))
      ->capture_default_str();
  app->add_option("--record", words->record,
                  "RUN.mcap: the trace of each robot, as RUN.r1.mcap and so on");
  app->add_option("--picture", words->picture,
                  "of all paths from above, .png or .svg; default: NAME.png");
  app->add_flag("--no-picture", words->no_picture, "no picture");
  cli::add_json_flag(*app, words->json);
  return {app, [words] { return run_demo(*words); }};
}

}  // namespace verp::tool
