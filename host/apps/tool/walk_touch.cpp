#include "host/apps/tool/walk_touch.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <set>
#include <stdexcept>

#include "host/apps/cli/command.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/suggest.hpp"
#include "host/run/session/intervention.hpp"
#include "host/twin/sim/quantities.hpp"

namespace verp::tool {
namespace {

using session::Intervention;

/// What a run will have, without running it.
struct Probe {
  Probe(const WalkPlan& plan, const std::vector<WalkPlan>& others, const sim::WorldOptions& options)
      : world(options), quantities(world) {
    if (world.scenery() != nullptr) quantities.add(*world.scenery());
    add(plan, others.empty());
    for (const WalkPlan& other : others) add(other, false);
  }
  void add(const WalkPlan& plan, bool alone) {
    robots.emplace_back(world, plan.entity, plan.twin);
    quantities.add(robots.back(), alone ? "" : plan.name + ".");
  }
  sim::World world;
  std::deque<sim::TwinRobot> robots;
  sim::Quantities quantities;
};

Intervention read(const std::string& option, const std::string& text,
                  Intervention (*reader)(const std::string&), const std::string& command) {
  try {
    return reader(text);
  } catch (const std::invalid_argument& error) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: {} '{}': {}", command, option, text, error.what()));
  }
}

std::string hint(const Intervention& each, const sim::Quantities& quantities) {
  const bool push = each.kind == Intervention::Kind::kPush;
  const std::vector<std::string> names = push ? quantities.things() : quantities.names();
  if (std::find(names.begin(), names.end(), each.name) != names.end()) return "";
  const std::string meant = cli::did_you_mean(each.name, names);
  return meant.empty() ? "; `verp walk --list-quantities` lists them" : meant;
}

void check_all(const std::vector<std::pair<std::string, Intervention>>& read, const WalkPlan& plan,
               const std::vector<WalkPlan>& others, const sim::WorldOptions& world,
               const std::string& command) {
  Probe probe(plan, others, world);
  for (const auto& [option, each] : read) {
    try {
      session::check(each, probe.quantities);
    } catch (const std::invalid_argument& error) {
      throw cli::ToolError(cli::kBadInput, fmt::format("{}: {}: {}{}", command, option,
                                                       error.what(), hint(each, probe.quantities)));
    }
    if (each.at_s <= plan.walk_s) continue;
    throw cli::ToolError(
        cli::kBadInput, fmt::format("{}: {}: {:g} s is after the end, {:g} s; raise --for", command,
                                    option, each.at_s, plan.walk_s));
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

void read_touch(const TouchOptions& options, WalkPlan& plan, const std::vector<WalkPlan>& others,
                const sim::WorldOptions& world) {
  std::vector<std::pair<std::string, Intervention>> all;
  for (const std::string& text : options.pushes)
    all.emplace_back("--push '" + text + "'",
                     read("--push", text, session::read_push, options.command));
  for (const std::string& text : options.settings)
    all.emplace_back("--at '" + text + "'",
                     read("--at", text, session::read_setting, options.command));
  if (all.empty()) return;
  check_all(all, plan, others, world, options.command);
  for (const auto& [option, each] : all) plan.interventions.push_back(each);
}

int list_quantities(const WalkPlan& plan, const std::vector<WalkPlan>& others,
                    const sim::WorldOptions& world, bool json) {
  Probe probe(plan, others, world);
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
  for (const session::Done& each : result.interventions) {
    out.push_back({{"tick", each.tick}, {"time_s", each.time_s}, {"what", each.what}});
  }
  return out;
}

std::string touch_text(const WalkResult& result) {
  std::string out;
  for (const session::Done& each : result.interventions) {
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
