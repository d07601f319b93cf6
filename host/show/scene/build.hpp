#pragma once
#include "host/robot/model/world.hpp"
#include "host/show/scene/scene.hpp"
#include "host/show/scene/snapshot.hpp"

namespace verp::scene {

/// Floor, sky, three lights.
Scene studio();

/// Things, lights and air; null: the studio. Moving things follow Snapshot::body_world, in the
/// order of model::moving().
Scene surroundings(const model::World* world);

enum class Meshes { kFromFiles, kNone };

/// Returns the robot's index. Without a drawable visual, a link shows collision shapes.
int add_robot(Scene& scene, const Entity& entity, Meshes meshes = Meshes::kFromFiles);

void tint(Scene& scene, int robot, const Colour& colour);

/// A robot in its own stance at start_m, as the twin begins.
RobotView standing(const Entity& entity, const Vec3& start_m = Vec3::Zero(), double yaw_rad = 0);

RobotView posed(const Entity& entity, const Transform& body_world,
                const std::vector<double>& joint_rad);

}  // namespace verp::scene
