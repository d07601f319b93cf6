#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/math/linear.hpp"
#include "common/model/params.hpp"
#include "host/apps/libverp/verp.h"

namespace verp::abi {

/// Writes the rotation, row by row, then the position.
void put_pose(const Pose& pose, float* to);

/// Plans `count` ticks from standing, the last `stop` of them after a stop order.
void plan_walk(const Params& params, const Command& velocity, verp_plan* plan, std::uint32_t count,
               std::uint32_t stop);

}  // namespace verp::abi
