#pragma once
#include <optional>

#include "common/gait/gait.hpp"
#include "host/twin/sim/truth.hpp"

namespace verp::sim {

/// Where the plan has the ZMP now, on the twin's ground: what the measured one is held against.
/// `gait` is the controller's, after its tick. The plan lives in the gait's own walk frame, so it
/// is placed by the foot that carries or is about to: as far ahead of and beside the true sole as
/// it is of the planned foothold. Between the two soles while the plan names no such foot; nothing
/// while the gait stands.
std::optional<Vec2> planned_zmp_world_m(const Tuning& tuning, const gait::GaitState& gait,
                                        const Truth& truth);

}  // namespace verp::sim
