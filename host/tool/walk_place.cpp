#include "host/tool/walk_place.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "host/link/system_clock.hpp"
#include "host/model/load_world.hpp"
#include "host/model/number.hpp"
#include "host/sim/scenery.hpp"
#include "host/tool/command.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/walk_cameras.hpp"

namespace verp::tool {

void declare(CLI::App& app, PlaceOptions& options) {
  app.add_option("--world", options.world,
                 "a world of common/worlds, or the path of an SDF file (default: a level floor)");
  app.add_option("--at-pose", options.pose_text,
                 "X,Y,YAW in m and rad: where the robot stands at the start");
}

void read_place(const PlaceOptions& options, sim::WorldOptions& world) {
  if (options.world.empty()) return;
  world = sim::furnished(world, model::load_world(model::find_world(options.world)));
}

void place_robot(const PlaceOptions& options, WalkPlan& plan) {
  constexpr double kFar_m = 1000;
  if (options.pose_text.empty()) return;
  std::string spaced = options.pose_text;
  for (char& c : spaced) c = c == ',' ? ' ' : c;
  const auto value = model::parse_numbers(spaced);
  const bool far = value && value->size() == 3 &&
                   (std::abs((*value)[0]) > kFar_m || std::abs((*value)[1]) > kFar_m ||
                    std::abs((*value)[2]) > kFar_m);
  if (!value || value->size() != 3 || far) {
    throw ToolError(kBadInput,
                    fmt::format("verp walk: --at-pose '{}' is not X,Y,YAW; example: 1,0.5,1.57",
                                options.pose_text));
  }
  plan.twin.start_m.x() = (*value)[0];
  plan.twin.start_m.y() = (*value)[1];
  plan.twin.start_yaw_rad = (*value)[2];
}

Walks walk_together(const WalkPlan& plan, const std::vector<WalkPlan>& others,
                    record::TraceWriter* trace, Progress& progress, bool keep_series,
                    const sim::WorldOptions& world, WalkCameras* cameras, bool real_time) {
  session::Session session({.world = world, .interrupted = interrupted});
  session::Hooks hooks = shown(plan, trace, progress, plan.params.name, keep_series);
  if (cameras != nullptr) cameras->watch(session, plan, hooks);
  const session::Robot& first = session.add(plan, std::move(hooks));
  for (const WalkPlan& other : others) session.add(other);
  wire::SystemClock clock;
  app::Pacer pacer(clock);
  const std::uint64_t begun_us = clock.now_us();
  if (real_time) pacer.start(plan.params.period_us);
  while (const session::Robot* robot = session.tick()) {
    if (real_time && robot == &first) pacer.next();
  }
  if (cameras != nullptr) cameras->finish();
  Walks walks;
  walks.deadlines = pacer.deadlines();
  walks.took_s = 1e-6 * static_cast<double>(clock.now_us() - begun_us);
  walks.result = session.result(0);
  for (std::size_t i = 0; i < others.size(); ++i)
    walks.others.emplace_back(others[i].name, session.result(i + 1));
  const sim::Scenery* scenery = session.scenery();
  for (std::size_t i = 0; scenery != nullptr && i < scenery->items().size(); ++i) {
    const model::WorldObject& object = *scenery->items()[i].object;
    if (object.kind == model::WorldObject::Kind::kStatic) continue;
    const model::Vec3 at = scenery->pose(i).translation();
    walks.objects.push_back({{"name", object.name}, {"position_m", {at.x(), at.y(), at.z()}}});
  }
  return walks;
}

std::string place_text(const Walks& walks, const sim::WorldOptions& world) {
  if (world.scenery == nullptr) return "";
  std::string out =
      fmt::format("  {:<18}{}, {}\n", "world", world.scenery->name, world.scenery->file);
  for (const Json& each : walks.objects) {
    const Json& at = each["position_m"];
    out += fmt::format("  {:<18}at the end at {:.3f} {:.3f} {:.3f} m\n",
                       each["name"].get<std::string>(), at[0].get<double>(), at[1].get<double>(),
                       at[2].get<double>());
  }
  for (const auto& [name, result] : walks.others) {
    out += fmt::format("  {:<18}{}, {:.2f} m, digest 0x{:016x}\n", name,
                       result.failure.empty() ? "walked" : result.failure,
                       result.metrics.distance_m, result.digest);
  }
  return out;
}

Json place_json(const Walks& walks, const sim::WorldOptions& world) {
  if (world.scenery == nullptr) return Json::object();
  Json out = {{"world", world.scenery->file}, {"objects", walks.objects}};
  for (const auto& [name, result] : walks.others) {
    out["others"].push_back({{"name", name},
                             {"failure", result.failure},
                             {"distance_m", result.metrics.distance_m},
                             {"digest", fmt::format("0x{:016x}", result.digest)}});
  }
  return out;
}

}  // namespace verp::tool
