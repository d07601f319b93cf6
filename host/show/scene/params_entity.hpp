#pragma once
#include "common/model/params.hpp"
#include "host/show/scene/scene.hpp"

namespace verp::scene {

/// A robot from Params alone: tree, soles, and bones to draw.
Entity entity_of(const Params& params);

}  // namespace verp::scene
