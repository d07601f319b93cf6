#pragma once
#include <sched.h>

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

/// Keeps this thread, and the processes that it starts, on one core: processes that wake each other
/// across cores are up to seven times slower, by chance of their places.
class OneCore {
 public:
  OneCore();
  ~OneCore();
  OneCore(const OneCore&) = delete;
  OneCore& operator=(const OneCore&) = delete;

 private:
  cpu_set_t before_{};
};

/// The link's peer: round trips a second of such frames between two processes of this PC.
double measure_pipes(std::uint32_t round_trips);

}  // namespace verp::board
