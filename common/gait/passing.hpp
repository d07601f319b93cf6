#pragma once
#include "common/gait/types.hpp"
#include "common/model/params.hpp"

/// The swing foot's path past the stance foot.
namespace verp::gait {

/// How far the swing foot's path must bend outward at mid-swing (Step::bend_m) to keep its sole
/// `wanted_m` from the stance sole, seen from above: at a few millimetres of height it would touch.
/// Zero if the straight path is clear, as it always is when no foot turns.
Xy bend_beside(const Params& params, float wanted_m, const Step& step);

}  // namespace verp::gait
