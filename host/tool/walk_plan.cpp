#include "host/tool/walk_plan.hpp"

#include <fmt/format.h>

#include <utility>

#include "host/model/find.hpp"
#include "host/model/load.hpp"
#include "host/model/params.hpp"
#include "host/sim/vary.hpp"

namespace verp::tool {

using session::WalkPlan;

WalkPlan make_plan(const WalkOptions& options) {
  check_board(options);
  WalkPlan plan;
  plan.entity = model::load_robot(model::find_model(options.model), options.bus);
  if (!options.board.empty()) require_serial("verp walk --on", plan.entity);
  plan.params = model::make_params(plan.entity);
  apply_tuning(options, plan.params.tuning);
  plan.velocity = velocity_of(options, options.step_m);
  plan.walk_s = options.walk_s;
  plan.twin.seed = options.seed;
  plan.board = options.board;
  return plan;
}

Drawn draw(const WalkOptions& options, WalkPlan& plan, sim::WorldOptions& world) {
  Drawn drawn;
  drawn.json["physics_step_ms"] = options.physics_step_ms;
  if (!options.vary) return drawn;
  sim::Varied varied = sim::vary(plan.entity, plan.twin, world);
  plan.entity = std::move(varied.entity);
  plan.twin = varied.twin;
  world = varied.world;
  drawn.text = fmt::format("varied by seed {}:\n", plan.twin.seed);
  for (const auto& [name, value] : varied.drawn) {
    drawn.json["varied"][name] = value;
    drawn.text += fmt::format("  {:<24} {:.4g}\n", name, value);
  }
  return drawn;
}

}  // namespace verp::tool
