#include "host/show/scene/object_track.hpp"

#include <algorithm>

#include "host/show/scene/body_track.hpp"

namespace verp::scene {

ObjectTrack::ObjectTrack(const record::Trace& trace, const model::World& world) {
  const std::vector<const model::WorldObject*> moving = model::moving(world);
  for (const model::WorldObject* object : moving) start_.push_back(object->pose);
  for (const record::ObjectsAt& recorded : trace.objects) {
    Kept& kept = kept_.emplace_back(Kept{recorded.index, start_});
    for (const record::ros::ObjectPose& object : recorded.objects) {
      const auto found = std::find_if(moving.begin(), moving.end(),
                                      [&](const auto* each) { return each->name == object.name; });
      if (found == moving.end()) continue;
      kept.poses[static_cast<std::size_t>(found - moving.begin())] = to_transform(object.pose);
    }
  }
}

std::vector<Transform> ObjectTrack::at(std::size_t tick) const {
  if (kept_.empty()) return start_;
  const auto after =
      std::upper_bound(kept_.begin(), kept_.end(), tick,
                       [](std::size_t at, const Kept& kept) { return at < kept.tick; });
  if (after == kept_.begin()) return kept_.front().poses;
  if (after == kept_.end()) return kept_.back().poses;
  const Kept& before = *(after - 1);
  const double part =
      static_cast<double>(tick - before.tick) / static_cast<double>(after->tick - before.tick);
  std::vector<Transform> poses;
  for (std::size_t i = 0; i < start_.size(); ++i)
    poses.push_back(between(before.poses[i], after->poses[i], part));
  return poses;
}

}  // namespace verp::scene
