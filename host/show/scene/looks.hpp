#pragma once
#include "host/show/scene/scene.hpp"

namespace verp::scene {

/// A visual whose file says nothing of its colour: by what it is of a robot.
Material default_material(const Entity& entity, int node, const Vec3& extent_m);

/// How much the edges of a box or cylinder are rounded: things are made so, and light shows them.
double rounding_m(Shape shape, const Vec3& size_m);

}  // namespace verp::scene
