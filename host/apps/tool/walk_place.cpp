#include "host/apps/tool/walk_place.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/apps/cli/command.hpp"
#include "host/robot/model/number.hpp"

namespace verp::tool {

void declare(CLI::App& app, PlaceOptions& options) {
  app.add_option("--world", options.world,
                 "a world of common/worlds, or the path of an SDF file (default: a level floor)");
  app.add_option("--at-pose", options.poses,
                 "X,Y,YAW in m and rad: where the robot stands at the start; one of several: "
                 "NAME=X,Y,YAW");
}

namespace {

/// Throws ToolError unless `text` is X,Y,YAW.
void place_robot(const std::string& text, scenario::Robot& robot) {
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
  robot.at = {(*value)[0], (*value)[1], (*value)[2]};
}

}  // namespace

void place_robots(const PlaceOptions& options, std::vector<scenario::Robot>& robots) {
  for (const std::string& text : options.poses) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos && robots.size() == 1) {
      place_robot(text, robots.front());
      continue;
    }
    const std::string name = equals == std::string::npos ? "" : text.substr(0, equals);
    const auto robot = std::find_if(robots.begin(), robots.end(),
                                    [&](const auto& each) { return each.name == name; });
    if (robot == robots.end() || name.empty()) {
      std::string names;
      for (const auto& each : robots) names += (names.empty() ? "" : ", ") + each.name;
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
