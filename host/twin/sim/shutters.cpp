#include "host/twin/sim/shutters.hpp"

#include "host/twin/sim/scenery.hpp"

namespace verp::sim {
namespace {

constexpr std::size_t kMostExposures = 1000;

}  // namespace

Shutters::Shutters(const model::Entity& entity, bool wanted) : entity_(entity) {
  if (!wanted) return;
  for (const model::CameraSensor& camera : entity.cameras) {
    shutter_.emplace_back(camera.rate_hz);
    developing_.emplace_back(camera.latency_s);
  }
}

Exposure Shutters::expose(const World& world, const Actor& robot) {
  Exposure now{.time_us = world.now_us(), .cameras = {}, .link_world = {}, .body_world = {}};
  for (const Actor* each : world.actors()) {
    std::vector<model::Transform> links = each->link_poses();
    if (links.empty()) continue;
    if (each == &robot) now.robot = now.link_world.size();
    now.link_world.push_back(std::move(links));
  }
  if (world.scenery() != nullptr) now.body_world = world.scenery()->moving_poses();
  return now;
}

void Shutters::sample(const World& world, const Actor& robot) {
  const std::uint64_t now_us = world.now_us();
  std::vector<bool> looks;
  for (Shutter& each : shutter_) looks.push_back(each.opens(now_us));
  for (std::size_t i = 0; i < shutter_.size(); ++i) {
    if (!looks[i]) continue;
    Exposure now = expose(world, robot);
    for (std::size_t other = i; other < shutter_.size(); ++other) {
      const bool as_late = entity_.cameras[other].latency_s == entity_.cameras[i].latency_s;
      if (!looks[other] || !as_late) continue;
      looks[other] = false;
      now.cameras.push_back(other);
    }
    developing_[i].put(now_us, std::move(now));
  }
  for (Delay<Exposure>& each : developing_) {
    while (auto exposure = each.take(now_us)) {
      if (exposures_.size() == kMostExposures) exposures_.erase(exposures_.begin());
      exposures_.push_back(std::move(*exposure));
    }
  }
}

}  // namespace verp::sim
