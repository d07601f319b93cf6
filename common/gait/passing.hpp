#pragma once
#include "common/gait/types.hpp"
#include "common/model/params.hpp"

namespace verp::gait {

/// Outward bend of the swing path at mid-swing (Step::bend_m) that keeps its sole `wanted_m` from
/// the stance sole, seen from above. Zero without a turn.
Xy bend_beside(const Params& params, float wanted_m, const Step& step);

}  // namespace verp::gait
