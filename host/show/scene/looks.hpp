#pragma once
#include "host/show/scene/scene.hpp"

namespace verp::scene {

/// A material for a visual without colour.
Material default_material(const Entity& entity, int node, const Vec3& extent_m);

/// Edge radius, so that light shows the edges.
double rounding_m(Shape shape, const Vec3& size_m);

}  // namespace verp::scene
