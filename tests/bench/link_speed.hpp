#pragma once
#include <cstdint>
#include <string>

#include "common/model/params.hpp"

namespace verp::board {

/// What the link to an emulated board can do with the traffic of the control loop but neither a bus
/// nor physics behind it: a tick is four frames of 200 bytes from the board, two answers of 200
/// bytes, and one record.
struct LinkSpeed {
  double ticks_per_s = 0;
  double round_trips_per_s = 0;
};

/// With `with_step` the controller runs in the board as well. Wall-clock time: repeat it, and mind
/// the load.
LinkSpeed measure_link(const std::string& board, const Params& params, std::uint32_t ticks,
                       bool with_step);

}  // namespace verp::board
