#pragma once
#include <cstdint>
#include <vector>

#include "common/model/params.hpp"

namespace verp::replay {

struct Robot {
  const char* name;
  std::uint32_t percent;  ///< of the trace's ticks
  std::uint32_t seed;
  bool damaged;  ///< some inputs are random bits
  Params params;
};

std::vector<Robot> make_robots(const Params& robot);

}  // namespace verp::replay
