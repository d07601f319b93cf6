#pragma once
#include "host/robot/model/world.hpp"
#include "host/show/scene/scene.hpp"
#include "host/show/scene/snapshot.hpp"

namespace verp::scene {

/// Floor, sky, three lights.
Scene studio();

/// A world's things, lights and air; the studio if `world` is null. Moving things take their poses
/// from Snapshot::body_world, in the order of model::moving().
Scene surroundings(const model::World* world);

enum class Meshes { kFromFiles, kNone };

/// Adds visuals and cameras; returns the robot's index. A link without a drawable visual shows its
/// collision shapes.
int add_robot(Scene& scene, const Entity& entity, Meshes meshes = Meshes::kFromFiles);

/// Colours a robot to distinguish it from others of its model.
void tint(Scene& scene, int robot, const Colour& colour);

/// A robot on its feet in its own stance at start_m, as the twin begins.
RobotView standing(const Entity& entity, const Vec3& start_m = Vec3::Zero(), double yaw_rad = 0);

RobotView posed(const Entity& entity, const Transform& body_world,
                const std::vector<double>& joint_rad);

}  // namespace verp::scene
