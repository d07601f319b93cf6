#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/robot/model/load_world.hpp"

namespace verp::model {
namespace {

const char* word_for(WorldObject::Kind kind) {
  switch (kind) {
    case WorldObject::Kind::kStatic:
      return "stands";
    case WorldObject::Kind::kDynamic:
      return "is pushed";
    case WorldObject::Kind::kMoving:
      break;
  }
  return "moves by itself";
}

const char* word_for(Shape::Kind kind) {
  constexpr const char* kNames[] = {"plane",   "box",         "sphere", "cylinder",
                                    "capsule", "heightfield", "mesh"};
  return kNames[static_cast<int>(kind)];
}

std::string shapes_of(const WorldObject& object) {
  std::string text;
  for (const WorldCollision& each : object.collisions)
    text += (text.empty() ? "" : ", ") + std::string(word_for(each.shape.kind));
  return text.empty() ? "nothing to touch" : text;
}

}  // namespace

std::string describe(const World& world) {
  std::string text =
      fmt::format("{}: a world of {} objects, {} lights{}\n  gravity {:g} {:g} {:g} m/s^2\n",
                  world.name, world.objects.size(), world.lights.size(), world.fog ? ", fog" : "",
                  world.gravity_m_s2.x(), world.gravity_m_s2.y(), world.gravity_m_s2.z());
  for (const WorldObject& each : world.objects) {
    const Vec3 at = each.pose.translation();
    const ContactSurface surface =
        each.collisions.empty() ? ContactSurface{} : each.collisions[0].surface;
    text +=
        fmt::format("  {:<20} {:<16} at {:g} {:g} {:g} m, {}; friction {:g}, restitution {:g}\n",
                    each.name, word_for(each.kind), at.x(), at.y(), at.z(), shapes_of(each),
                    surface.friction, surface.restitution);
  }
  for (const WorldRobot& each : world.robots) {
    text += fmt::format("  robot {} at {:g} {:g} m, {:g} rad: {}\n", each.name, each.x_m, each.y_m,
                        each.yaw_rad, each.file);
  }
  return text;
}

std::string describe_json(const World& world) {
  nlohmann::ordered_json out = {{"world", world.name},
                                {"file", world.file},
                                {"lights", world.lights.size()},
                                {"objects", nlohmann::ordered_json::array()},
                                {"robots", nlohmann::ordered_json::array()}};
  for (const WorldObject& each : world.objects) {
    const Vec3 at = each.pose.translation();
    nlohmann::ordered_json shapes = nlohmann::ordered_json::array();
    for (const WorldCollision& one : each.collisions) shapes.push_back(word_for(one.shape.kind));
    out["objects"].push_back({{"name", each.name},
                              {"kind", word_for(each.kind)},
                              {"position_m", {at.x(), at.y(), at.z()}},
                              {"shapes", shapes}});
  }
  for (const WorldRobot& each : world.robots)
    out["robots"].push_back({{"name", each.name}, {"file", each.file}});
  return out.dump(2) + "\n";
}

}  // namespace verp::model
