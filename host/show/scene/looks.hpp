#pragma once
#include "host/show/scene/scene.hpp"

namespace verp::scene {

/// A material for a visual without a colour, by its place in the robot.
Material default_material(const Entity& entity, int node, const Vec3& extent_m);

/// Edge radius, so that light shows the edges.
double rounding_m(Shape shape, const Vec3& size_m);

}  // namespace verp::scene
