#pragma once
#include <optional>

#include "common/gait/gait.hpp"
#include "host/twin/sim/truth.hpp"

namespace verp::sim {

/// `gait`: the controller's state after its tick. The carrying foot aligns the plan's walk frame
/// with the world; without a swing foot the midpoint of both soles does. Nothing while the gait
/// stands.
std::optional<Vec2> planned_zmp_world_m(const Tuning& tuning, const gait::GaitState& gait,
                                        const Truth& truth);

}  // namespace verp::sim
