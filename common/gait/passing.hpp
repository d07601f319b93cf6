#pragma once
#include "common/gait/types.hpp"
#include "common/model/params.hpp"

/// A swing foot on its way past the carrying one.
namespace verp::gait {

/// How far the way of `step`'s swing foot has to bend outward at mid-swing (Step::bend_m), lest its
/// sole come nearer than `wanted_m` to the carrying one's as seen from above: a few millimetres up
/// it would touch. Zero where the straight way is clear: always where no foot turns.
Xy bend_beside(const Params& params, float wanted_m, const Step& step);

}  // namespace verp::gait
