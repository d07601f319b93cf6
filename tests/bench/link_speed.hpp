#pragma once
#include <cstdint>
#include <string>

#include "common/model/params.hpp"

namespace verp::board {

/// A tick is four frames of 200 bytes from the board, two such answers, and one record.
struct LinkSpeed {
  double ticks_per_s = 0;
  double round_trips_per_s = 0;
};

/// `with_step`: the board runs the controller. Wall-clock time.
LinkSpeed measure_link(const std::string& board, const Params& params, std::uint32_t ticks,
                       bool with_step);

}  // namespace verp::board
