#pragma once
#include "common/model/params.hpp"
#include "host/show/scene/scene.hpp"

namespace verp::scene {

/// A robot made of Params alone: tree and soles, with bones to draw.
Entity entity_of(const Params& params);

}  // namespace verp::scene
