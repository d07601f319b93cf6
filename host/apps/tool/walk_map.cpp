#include "host/apps/tool/walk_map.hpp"

#include <fmt/format.h>
#include <string.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_files.hpp"
#include "host/apps/tool/walk_options.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/os/files/folder_lock.hpp"
#include "host/study/report/report.hpp"
#include "host/study/survey/draw.hpp"
#include "host/study/survey/page.hpp"
#include "host/study/survey/push_map.hpp"
#include "host/study/survey/stability_map.hpp"
#include "host/study/survey/words.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::tool {
namespace {

struct MapReport {
  survey::Page page;
  cli::Json json;
  std::string text;
  bool interrupted = false;
};

using CellEnd = survey::StabilityCell::End;

constexpr double kDegrees = 180 / std::numbers::pi;

std::string robot_of(const Params& params) {
  return {params.name, ::strnlen(params.name, kNameLength)};
}

MapReport begun(const WalkOptions& options, const WalkPlan& plan, const std::string& title,
                const std::string& verdict, bool interrupted) {
  MapReport told;
  told.interrupted = interrupted;
  told.page.title = robot_of(plan.params) + ": " + title;
  told.page.verdict = verdict;
  told.page.good = !interrupted;
  told.page.changed = options.changed;
  told.page.provenance = {{"robot", robot_of(plan.params)},
                          {"model file", plan.entity.file},
                          {"seed", std::to_string(plan.twin.seed)},
                          {"length of each walk", fmt::format("{:g} s", plan.walk_s)},
                          {"physics step", fmt::format("{:g} ms", options.physics_step_ms)}};
  for (const auto& [key, value] : record::build_info())
    told.page.provenance.emplace_back(key, value);
  told.json = {{"model", robot_of(plan.params)},
               {"map", options.map.kind},
               {"seed", plan.twin.seed},
               {"walk_s", plan.walk_s},
               {"interrupted", interrupted}};
  told.text = told.page.title + "\n  " + verdict + '\n';
  for (const auto& [name, value] : options.changed)
    told.text += fmt::format("  {:<18}{}\n", "changed", name + " " + value);
  return told;
}

cli::Json json_of(const survey::Velocity& velocity) {
  return {velocity.vx_m_s, velocity.vy_m_s, velocity.wz_rad_s};
}

std::string tried(std::size_t done, std::size_t of, const char* what) {
  return done == of ? fmt::format("{} {}", of, what) : fmt::format("{} of {} {}", done, of, what);
}

std::size_t done_of(const survey::PushMap& map) {
  return static_cast<std::size_t>(
      std::count_if(map.cells.begin(), map.cells.end(),
                    [](const survey::PushCell& cell) { return cell.survives_n_s.has_value(); }));
}

cli::Json sides_json(const std::vector<survey::Side>& sides) {
  cli::Json out = cli::Json::array();
  for (const survey::Side& side : sides) {
    out.push_back({{"direction_deg", kDegrees * side.direction_rad},
                   {"weakest_n_s", side.least_n_s},
                   {"weakest_phase", side.least_phase},
                   {"middle_n_s", side.middle_n_s},
                   {"strongest_n_s", side.most_n_s}});
  }
  return out;
}

MapReport tell(const WalkOptions& options, const WalkPlan& plan, const survey::PushMap& map,
               const survey::PushOptions& asked) {
  const std::vector<survey::Side> sides = survey::sides_of(map);
  const auto weakest =
      std::min_element(sides.begin(), sides.end(),
                       [](const auto& a, const auto& b) { return a.least_n_s < b.least_n_s; });
  const std::size_t of =
      static_cast<std::size_t>(asked.phases) * static_cast<std::size_t>(asked.directions);
  std::string verdict =
      tried(done_of(map), of, "pushes") + fmt::format(" found in {} walks", map.walks);
  if (weakest != sides.end()) {
    verdict += fmt::format("; weakest: {:.1f} N s, {}", weakest->least_n_s,
                           survey::direction_name(weakest->direction_rad));
    if (!asked.standing) verdict += fmt::format(", phase {}", weakest->least_phase);
  }
  if (map.interrupted) verdict += "; interrupted";
  MapReport told = begun(options, plan,
                         fmt::format("pushes of {:g} ms while it {}", 1e3 * asked.push_s,
                                     asked.standing ? "stands" : "walks"),
                         verdict, map.interrupted);
  if (!plan.remark.empty()) told.text += fmt::format("  {:<18}{}\n", "remark", plan.remark);
  told.text += survey::text_of(map, asked);
  const survey::Velocity velocity = survey::velocity_of(plan.velocity);
  for (const survey::Side& side : sides) {
    told.page.facts.push_back({"Pushed " + survey::direction_name(side.direction_rad),
                               fmt::format("{:.1f} N s", side.least_n_s),
                               asked.standing
                                   ? ""
                                   : fmt::format("at phase {}; {:.1f} at half of the phases",
                                                 side.least_phase, side.middle_n_s)});
  }
  if (!asked.standing) told.page.plots.push_back(survey::push_plot(map, asked));
  told.page.plots.push_back(survey::push_rose(map, asked));
  told.page.csv = survey::csv_of(map);
  cli::Json cells = cli::Json::array();
  for (const survey::PushCell& cell : map.cells) {
    cells.push_back(
        {{"phase", cell.phase},
         {"direction_deg", kDegrees * cell.direction_rad},
         {"at_s", cell.at_s},
         {"survives_n_s", cell.survives_n_s ? cli::Json(*cell.survives_n_s) : cli::Json()}});
  }
  told.json.update({{"velocity", json_of(velocity)},
                    {"remark", plan.remark},
                    {"link", map.link},
                    {"push_s", asked.push_s},
                    {"told_apart_n_s", asked.step_n_s},
                    {"most_n_s", asked.most_n_s()},
                    {"phases", asked.phases},
                    {"directions", asked.directions},
                    {"walks", map.walks},
                    {"sides", sides_json(sides)},
                    {"cells", cells}});
  return told;
}

MapReport tell(const WalkOptions& options, const WalkPlan& plan, const survey::StabilityMap& map,
               const survey::StabilityOptions& asked) {
  const auto count = [&](CellEnd end) { return survey::count_of(map, end); };
  const std::size_t of = map.cells.size();
  const std::size_t done = of - static_cast<std::size_t>(count(CellEnd::kNone));
  const std::string verdict =
      tried(done, of, "velocities") +
      fmt::format(
          ": {} walked, {} went less than half of the way, {} fell{}{}", count(CellEnd::kWalked),
          count(CellEnd::kShort), count(CellEnd::kFell),
          count(CellEnd::kFailed) > 0 ? fmt::format(", {} failed", count(CellEnd::kFailed)) : "",
          map.interrupted ? "; interrupted" : "");
  MapReport told = begun(options, plan, fmt::format("{:g} s at each velocity", plan.walk_s),
                         verdict, map.interrupted);
  told.text += survey::text_of(map, asked);
  for (const CellEnd end : {CellEnd::kWalked, CellEnd::kShort, CellEnd::kFell}) {
    told.page.facts.push_back({survey::name_of(end), std::to_string(count(end)),
                               fmt::format("of {} velocities that were tried", done)});
  }
  told.page.plots = {survey::stability_plot(map, asked)};
  told.page.csv = survey::csv_of(map);
  cli::Json cells = cli::Json::array();
  for (const survey::StabilityCell& cell : map.cells) {
    const bool walked = cell.end != CellEnd::kNone;
    cells.push_back({{"asked", json_of(cell.asked)},
                     {"ordered", walked ? json_of(cell.ordered) : cli::Json()},
                     {"walked", cell.walked ? json_of(*cell.walked) : cli::Json()},
                     {"end", survey::name_of(cell.end)},
                     {"failure", cell.why}});
  }
  told.json.update({{"velocities_on_axis", asked.on_axis},
                    {"measured_from_s", asked.begin_s},
                    {"of", done},
                    {"walked", count(CellEnd::kWalked)},
                    {"short", count(CellEnd::kShort)},
                    {"fell", count(CellEnd::kFell)},
                    {"failed", count(CellEnd::kFailed)},
                    {"cells", cells}});
  return told;
}

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
