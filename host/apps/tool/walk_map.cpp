#include "host/apps/tool/walk_map.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/tool/walk_files.hpp"
#include "host/apps/tool/walk_map_report.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/os/files/folder_lock.hpp"
#include "host/study/report/report.hpp"
#include "host/study/survey/words.hpp"

namespace verp::tool {
namespace {

constexpr double kLength_s = 10;  // default length in a stability map
constexpr int kMostDirections = 36;

int grid_of(const MapOptions& options, int usual, int least, int most, const char* what) {
  const int grid = options.grid == 0 ? usual : options.grid;
  if (grid >= least && grid <= most) return grid;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp walk: --map {} --map-grid {}: give {} to {} {}",
                                   options.kind, grid, least, most, what));
}

/// A push map spends most time on the walk to the push.
double usual_push_s(const WalkPlan& plan) {
  return survey::least_walk_s(survey::PushOptions{},
                              static_cast<double>(plan.params.tuning.gait.cycle_s));
}

survey::PushOptions push_options(const WalkOptions& options, const WalkPlan& plan) {
  survey::PushOptions push;
  if (options.map.kind == "stand") push = survey::standing_pushes();
  push.directions =
      grid_of(options.map, push.directions, 1, kMostDirections, "directions to push in");
  if (push.standing) {
    if (!options.map.length_given && !options.changes("--velocity") && !options.changes("--step"))
      return push;
    throw cli::ToolError(
        cli::kBadInput,
        "verp walk: --map stand does not walk; leave --for, --velocity and --step out");
  }
  const double least_s =
      survey::least_walk_s(push, static_cast<double>(plan.params.tuning.gait.cycle_s));
  if (plan.walk_s >= least_s) return push;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp walk: --map push needs walks of {:.1f} s with this cycle, to "
                  "settle before the push and to walk on after it; raise --for",
                  std::ceil(10 * least_s) / 10));
}

survey::StabilityOptions stability_options(const WalkOptions& options, const WalkPlan& plan) {
  survey::StabilityOptions stability;
  stability.on_axis =
      grid_of(options.map, stability.on_axis, 3, kMostOnMapAxis, "velocities on an axis");
  if (stability.on_axis % 2 == 0) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("verp walk: --map stability --map-grid {}: give an odd number, so "
                    "that zero is among the velocities",
                    stability.on_axis));
  }
  if (options.changes("--velocity") || options.changes("--step")) {
    throw cli::ToolError(
        cli::kBadInput,
        "verp walk: --map stability walks at velocities of its own; leave --velocity "
        "and --step out");
  }
  const double least_s =
      survey::least_walk_s(stability, static_cast<double>(plan.params.tuning.gait.cycle_s));
  if (plan.walk_s < least_s) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp walk: --map stability needs walks of {:.1f} s with this "
                                     "cycle, to measure how fast they are; raise --for",
                                     std::ceil(10 * least_s) / 10));
  }
  stability.most = survey::most_of(plan.params);
  return stability;
}

/// "3 min 20 s left"; empty: too early.
std::string time_left(double share, double gone_s) {
  if (share < 0.01 || gone_s < 2) return "";
  const int left_s = static_cast<int>(gone_s * (1 - share) / share + 0.5);
  return left_s < 60 ? fmt::format(", {} s left", left_s)
                     : fmt::format(", {} min {} s left", left_s / 60, left_s % 60);
}

survey::Watch shown(cli::Progress& progress, const std::string& kind) {
  const auto start = std::chrono::steady_clock::now();
  return {.interrupted = cli::interrupted, .went_on = [&progress, kind, start](double share) {
            const double gone_s =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            progress.show(share, kind + " map" + time_left(share, gone_s));
          }};
}

int leave(const WalkOptions& options, const std::filesystem::path& folder, MapReport& told) {
  if (folder.empty()) return cli::kGood;
  try {
    const files::FolderLock lock(folder);
    const survey::WrittenPage written = survey::write_page(folder, told.page);
    if (!written.note.empty()) cli::complain(written.page.string() + ": " + written.note);
    told.json["report"] = written.page.string();
    told.text += fmt::format("  {:<18}{}\n", "report", written.page.string());
    return cli::kGood;
  } catch (const report::ReportError& error) {
    told.json["lost"] = {error.what()};
    cli::complain(options.command + ": " + error.what());
    return cli::kRunFailed;
  }
}

}  // namespace

int walk_map(const WalkOptions& options, const Walk& walk) {
  WalkPlan plan = walk.run.plans.front();
  const sim::WorldOptions& world = walk.run.world;
  const bool push = options.map.kind != "stability";
  if (!options.map.length_given) plan.walk_s = push ? usual_push_s(plan) : kLength_s;
  std::optional<survey::PushOptions> pushes;
  std::optional<survey::StabilityOptions> velocities;
  push ? void(pushes = push_options(options, plan))
       : void(velocities = stability_options(options, plan));
  const Drawn drawn = drawn_of(walk);
  const std::filesystem::path folder =
      options.report_folder.empty() && !options.json ? "report" : options.report_folder;
  if (!folder.empty()) make_folder(folder);
  cli::Progress progress(!options.json);
  const survey::Watch watch = shown(progress, options.map.kind);
  MapReport told;
  try {
    told = push ? tell(options, plan, survey::push_map(plan, world, *pushes, watch), *pushes)
                : tell(options, plan, survey::stability_map(plan, world, *velocities, watch),
                       *velocities);
  } catch (const survey::SurveyError& error) {
    progress.clear();
    throw cli::ToolError(cli::kRunFailed,
                         fmt::format("verp walk: --map {}: {}", options.map.kind, error.what()));
  }
  progress.clear();
  told.json.update(drawn.json);
  const int status = leave(options, folder, told);
  options.json ? cli::print_json(told.json) : cli::answer(told.text + drawn.text);
  if (!told.interrupted) return status;
  cli::complain("verp walk: interrupted; what was done by then is kept");
  return cli::kRunFailed;
}

}  // namespace verp::tool
