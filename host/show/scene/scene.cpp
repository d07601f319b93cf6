#include "host/show/scene/scene.hpp"

namespace verp::scene {
namespace {

int links_before(const Scene& scene, int robot) {
  int links = 0;
  for (int r = 0; r < robot; ++r) {
    links += static_cast<int>(scene.robots[static_cast<std::size_t>(r)].entity->nodes.size());
  }
  return links;
}

}  // namespace

int label_of(const Scene& scene, const Item& item) {
  if (item.robot != kWorld) return 1 + links_before(scene, item.robot) + item.node;
  int label = 1 + links_before(scene, static_cast<int>(scene.robots.size()));
  const Item* last = nullptr;
  for (const Item& other : scene.items) {
    if (other.robot != kWorld) continue;
    if (last != nullptr && last->name != other.name) ++label;
    if (&other == &item) return label;
    last = &other;
  }
  return 0;
}

std::string label_name(const Scene& scene, int label) {
  for (const Item& item : scene.items) {
    if (label_of(scene, item) != label) continue;
    if (item.robot == kWorld) return item.name;
    const Robot& robot = scene.robots[static_cast<std::size_t>(item.robot)];
    return robot.name + "/" + robot.entity->nodes[static_cast<std::size_t>(item.node)].name;
  }
  return {};
}

}  // namespace verp::scene
