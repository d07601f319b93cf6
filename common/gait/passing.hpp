#pragma once
#include "common/gait/types.hpp"
#include "common/model/params.hpp"

/// The swing foot's path past the stance foot.
namespace verp::gait {

/// Outward bend of the swing foot's path at mid-swing (Step::bend_m) that keeps its sole `wanted_m`
/// from the stance sole, seen from above: a few millimetres up it would touch. Zero if the straight
/// path is clear, as always without a turn.
Xy bend_beside(const Params& params, float wanted_m, const Step& step);

}  // namespace verp::gait
