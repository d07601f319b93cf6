#include "host/apps/demos/eyes.hpp"

#include <algorithm>
#include <filesystem>

namespace verp::demos {
namespace {

std::string absolute(const std::string& file) {
  return file.empty() ? "" : std::filesystem::absolute(file).string();
}

camera::Stage stage_of(const std::vector<const session::WalkPlan*>& plans,
                       const sim::WorldOptions& world) {
  camera::Stage stage;
  for (const session::WalkPlan* plan : plans)
    stage.robots.push_back({absolute(plan->entity.file), plan->twin.seed});
  if (world.scenery != nullptr) stage.world_file = absolute(world.scenery->file);
  return stage;
}

}  // namespace

Eyes::Eyes(const std::vector<const session::WalkPlan*>& plans, const sim::WorldOptions& world)
    : stage_(stage_of(plans, world)), painter_(camera::find_program(), stage_) {}

std::optional<camera::Picture> Eyes::look(const sim::Exposure& exposure) {
  if (std::find(exposure.cameras.begin(), exposure.cameras.end(), 0u) == exposure.cameras.end())
    return std::nullopt;
  camera::Moment moment;
  moment.time_us = exposure.time_us;
  moment.cameras = {0};
  moment.link_world = exposure.link_world;
  moment.body_world = exposure.body_world;
  moment.robot = static_cast<std::uint32_t>(exposure.robot);
  moment.raw = true;
  for (camera::Picture& picture : painter_.look(moment)) {
    if (picture.encoding == "rgb8") return std::move(picture);
  }
  return std::nullopt;
}

}  // namespace verp::demos
