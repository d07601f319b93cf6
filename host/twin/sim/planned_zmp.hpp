#pragma once
#include <optional>

#include "common/gait/gait.hpp"
#include "host/twin/sim/truth.hpp"

namespace verp::sim {

/// The planned ZMP now, in the twin's world, to compare with the measured one. `gait` is the
/// controller's state after its tick. The plan uses the gait's walk frame, so it is aligned by the
/// foot that carries or is about to. The result has the same offset from the true sole as the plan
/// has from the planned foothold. In double support the midpoint of both soles is used. Nothing
/// while the gait stands.
std::optional<Vec2> planned_zmp_world_m(const Tuning& tuning, const gait::GaitState& gait,
                                        const Truth& truth);

}  // namespace verp::sim
