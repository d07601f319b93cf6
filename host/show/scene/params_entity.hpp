#pragma once
#include "common/model/params.hpp"
#include "host/show/scene/scene.hpp"

namespace verp::scene {

/// A robot to look at, made of the controller's numbers alone: its tree and soles, bones for looks.
Entity entity_of(const Params& params);

}  // namespace verp::scene
