#include "host/apps/tool/walk_map_report.hpp"

#include <fmt/format.h>
#include <string.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/study/survey/draw.hpp"
#include "host/study/survey/words.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::tool {
namespace {

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

}  // namespace

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

}  // namespace verp::tool
