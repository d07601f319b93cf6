#pragma once
#include <optional>

#include "common/gait/gait.hpp"
#include "host/twin/sim/truth.hpp"

namespace verp::sim {

/// The planned ZMP now, in the twin's world, to compare with the measured one. `gait` is the
/// controller's state after its tick. The plan is in the gait's walk frame, so the carrying foot of
/// the step aligns it: the result lies relative to the true sole as the plan lies relative to the
/// foothold. In a step without a swing foot, the midpoint of both soles aligns it. Nothing while
/// the gait stands.
std::optional<Vec2> planned_zmp_world_m(const Tuning& tuning, const gait::GaitState& gait,
                                        const Truth& truth);

}  // namespace verp::sim
