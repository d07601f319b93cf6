#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/math/linear.hpp"
#include "common/model/params.hpp"
#include "host/apps/libverp/verp.h"

namespace verp::abi {

/// Rotation, row by row, then position.
void put_pose(const Pose& pose, float* to);

/// The gait alone, from standing: what it plans for each of `count` ticks, the last `stop` of them
/// after it was asked to stop.
void plan_walk(const Params& params, const Command& velocity, verp_plan* plan, std::uint32_t count,
               std::uint32_t stop);

}  // namespace verp::abi
