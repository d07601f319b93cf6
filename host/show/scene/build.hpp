#pragma once
#include "host/robot/model/world.hpp"
#include "host/show/scene/scene.hpp"
#include "host/show/scene/snapshot.hpp"

namespace verp::scene {

/// An empty studio: floor, sky, three lights.
Scene studio();

/// The things, lights and air of a world's file; the studio if `world` is null. Moving things take
/// their poses from Snapshot::body_world, in the order of model::moving().
Scene surroundings(const model::World* world);

enum class Meshes { kFromFiles, kNone };

/// Adds a robot's visuals and cameras and returns its index. A link without a visual that can be
/// drawn shows its collision shapes.
int add_robot(Scene& scene, const Entity& entity, Meshes meshes = Meshes::kFromFiles);

/// Colours a robot to distinguish it from another of the same model.
void tint(Scene& scene, int robot, const Colour& colour);

/// A robot on its feet in its own stance at start_m, as the twin begins.
RobotView standing(const Entity& entity, const Vec3& start_m = Vec3::Zero(), double yaw_rad = 0);

/// A robot in any pose.
RobotView posed(const Entity& entity, const Transform& body_world,
                const std::vector<double>& joint_rad);

}  // namespace verp::scene
