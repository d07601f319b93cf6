#include "host/apps/tool/walk_place.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/apps/cli/command.hpp"
#include "host/robot/model/load_world.hpp"
#include "host/robot/model/number.hpp"

namespace verp::tool {

void declare(CLI::App& app, PlaceOptions& options) {
  app.add_option("--world", options.world,
                 "a world of common/worlds, or the path of an SDF file (default: a level floor)");
  app.add_option("--at-pose", options.poses,
                 "X,Y,YAW in m and rad: where the robot stands at the start; one of several: "
                 "NAME=X,Y,YAW");
}

void read_place(const PlaceOptions& options, sim::WorldOptions& world) {
  if (options.world.empty()) return;
  world = sim::furnished(world, model::load_world(model::find_world(options.world)));
}

namespace {

/// Throws ToolError unless `text` is X,Y,YAW.
void place_robot(const std::string& text, WalkPlan& plan) {
  constexpr double kFar_m = 1000;
  std::string spaced = text;
  for (char& c : spaced) c = c == ',' ? ' ' : c;
  const auto value = model::parse_numbers(spaced);
  const bool far = value && value->size() == 3 &&
                   (std::abs((*value)[0]) > kFar_m || std::abs((*value)[1]) > kFar_m ||
                    std::abs((*value)[2]) > kFar_m);
  if (!value || value->size() != 3 || far) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("verp walk: --at-pose '{}' is not X,Y,YAW; example: 1,0.5,1.57", text));
  }
  plan.twin.start_m.x() = (*value)[0];
  plan.twin.start_m.y() = (*value)[1];
  plan.twin.start_yaw_rad = (*value)[2];
}

}  // namespace

void place_robots(const PlaceOptions& options, std::vector<WalkPlan>& plans) {
  for (const std::string& text : options.poses) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos && plans.size() == 1) {
      place_robot(text, plans.front());
      continue;
    }
    const std::string name = equals == std::string::npos ? "" : text.substr(0, equals);
    const auto robot = std::find_if(plans.begin(), plans.end(),
                                    [&](const WalkPlan& plan) { return plan.name == name; });
    if (robot == plans.end() || name.empty()) {
      std::string names;
      for (const WalkPlan& plan : plans) names += (names.empty() ? "" : ", ") + plan.name;
      throw cli::ToolError(cli::kBadInput,
                           fmt::format("verp walk: --at-pose {}: say whose it is: "
                                       "NAME=X,Y,YAW, with a name out of: {}",
                                       text, names.empty() ? "(one robot: none)" : names));
    }
    place_robot(text.substr(equals + 1), *robot);
  }
}

cli::Json objects_of(const sim::Scenery& scenery) {
  cli::Json objects = cli::Json::array();
  for (std::size_t i = 0; i < scenery.items().size(); ++i) {
    const model::WorldObject& object = *scenery.items()[i].object;
    if (object.kind == model::WorldObject::Kind::kStatic) continue;
    const model::Vec3 at = scenery.pose(i).translation();
    objects.push_back({{"name", object.name}, {"position_m", {at.x(), at.y(), at.z()}}});
  }
  return objects;
}

}  // namespace verp::tool
