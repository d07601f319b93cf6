#pragma once
#include "host/robot/model/world.hpp"
#include "host/show/scene/scene.hpp"
#include "host/show/scene/snapshot.hpp"

namespace verp::scene {

/// An empty studio: floor, sky, three lights.
Scene studio();

/// What a world's file shows: its things, lights and air; null: the studio. What moves is in
/// Snapshot::body_world, in the order of model::moving().
Scene surroundings(const model::World* world);

enum class Meshes { kFromFiles, kNone };

/// One more robot: its visuals; a link without any that can be drawn shows its collision shapes.
/// Its cameras become the scene's. Returns its index.
int add_robot(Scene& scene, const Entity& entity, Meshes meshes = Meshes::kFromFiles);

/// Colours a robot so that it is told from another one like it.
void tint(Scene& scene, int robot, const Colour& colour);

/// A robot on its feet in its own stance at start_m, as the twin begins.
RobotView standing(const Entity& entity, const Vec3& start_m = Vec3::Zero(), double yaw_rad = 0);

/// Any pose.
RobotView posed(const Entity& entity, const Transform& body_world,
                const std::vector<double>& joint_rad);

}  // namespace verp::scene
