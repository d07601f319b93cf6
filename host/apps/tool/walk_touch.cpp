#include "host/apps/tool/walk_touch.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "host/apps/cli/command.hpp"
#include "host/apps/cli/console.hpp"
#include "host/run/scenario/probe.hpp"
#include "host/run/session/intervention.hpp"

namespace verp::tool {
namespace {

using session::Intervention;

Intervention read(const std::string& option, const std::string& text,
                  Intervention (*reader)(const std::string&), const std::string& command) {
  try {
    return reader(text);
  } catch (const std::invalid_argument& error) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: {} '{}': {}", command, option, text, error.what()));
  }
}

}  // namespace

void declare_push(CLI::App& app, TouchOptions& options) {
  app.add_option("--push", options.pushes,
                 "'T: LINK fx,fy,fz N for S': push it T s into the gait, in the world's axes; may "
                 "be repeated")
      ->allow_extra_args(false);
}

void declare(CLI::App& app, TouchOptions& options) {
  declare_push(app, options);
  app.add_option(
         "--at", options.settings,
         "'T: NAME=VALUE': set a quantity of the physics T s into the gait; may be repeated")
      ->allow_extra_args(false);
  app.add_flag("--list-quantities", options.list,
               "the names that --at may set, with unit and range, and those that can be read");
}

std::vector<Intervention> disturbances_of(const TouchOptions& options) {
  std::vector<Intervention> all;
  for (const std::string& text : options.pushes)
    all.push_back(read("--push", text, session::read_push, options.command));
  for (const std::string& text : options.settings)
    all.push_back(read("--at", text, session::read_setting, options.command));
  return all;
}

std::string option_of(const TouchOptions& options, std::size_t index) {
  const std::size_t pushes = options.pushes.size();
  return index < pushes ? "--push '" + options.pushes[index] + "'"
                        : "--at '" + options.settings.at(index - pushes) + "'";
}

int list_quantities(const scenario::Expanded& run, bool json) {
  scenario::Probe probe(run);
  const WalkPlan& plan = run.plans.front();
  cli::Json all = cli::Json::array();
  std::string text;
  std::set<std::string> kinds;
  for (const sim::Quantity& q : probe.quantities.all()) {
    cli::Json row = {{"name", q.name}, {"unit", q.unit}, {"what", q.what}, {"value", q.read()}};
    if (q.settable()) row["low"] = q.low, row["high"] = q.high;
    all.push_back(row);
    const std::string kind = q.name.substr(q.name.find('.') + 1);
    if (!kinds.insert(kind + q.what).second) continue;
    const std::string range =
        q.settable() ? fmt::format("set {:g} to {:g}", q.low, q.high) : "read";
    text += fmt::format("  {:<44}{:<10}{:<24}{}\n", q.name, q.unit, range, q.what);
  }
  if (json) {
    cli::print_json({{"model", plan.params.name}, {"quantities", all}});
    return cli::kGood;
  }
  std::string names;
  for (const std::string& thing : probe.quantities.things()) names += " " + thing;
  std::string joints;
  for (const model::Joint& joint : plan.entity.joints) joints += " " + joint.name;
  cli::answer(
      fmt::format("{}: {} quantities; one of each kind:\n{}\nthings that can be pushed:{}\n"
                  "joints:{}\n",
                  plan.params.name, probe.quantities.all().size(), text, names, joints));
  return cli::kGood;
}

cli::Json touch_json(const WalkResult& result) {
  cli::Json out = cli::Json::array();
  for (const session::AppliedIntervention& each : result.interventions) {
    out.push_back({{"tick", each.tick}, {"time_s", each.time_s}, {"what", each.what}});
  }
  return out;
}

std::string touch_text(const WalkResult& result) {
  std::string out;
  for (const session::AppliedIntervention& each : result.interventions) {
    out += fmt::format("  {:<18}after tick {}, at {:.3f} s simulated: {}\n", "done", each.tick,
                       each.time_s, each.what);
  }
  return out;
}

std::vector<std::string> never_done(const WalkPlan& plan, const WalkResult& result) {
  std::vector<Intervention> sorted = plan.interventions;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Intervention& a, const Intervention& b) { return a.at_s < b.at_s; });
  std::vector<std::string> lines;
  for (std::size_t i = result.interventions.size(); i < sorted.size(); ++i) {
    lines.push_back(fmt::format("verp walk: '{:g}: {}' was not done: the gait was over before",
                                sorted[i].at_s, session::in_words(sorted[i])));
  }
  return lines;
}

}  // namespace verp::tool
