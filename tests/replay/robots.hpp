#pragma once
#include <cstdint>
#include <vector>

#include "common/model/params.hpp"

/// The robots of the long trace: one real one, and variants of what others may be.
namespace verp::replay {

struct Robot {
  const char* name;
  std::uint32_t percent;  ///< share of the trace's ticks
  std::uint32_t seed;
  bool damaged;  ///< sometimes its inputs hold random bits
  Params params;
};

std::vector<Robot> make_robots(const Params& robot);

}  // namespace verp::replay
