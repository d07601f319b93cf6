#pragma once
#include <cstdint>
#include <vector>

#include "common/model/params.hpp"

/// The robots of the long trace: one real one, and what others may be like.
namespace verp::replay {

struct Robot {
  const char* name;
  std::uint32_t percent;  ///< share of the trace's ticks
  std::uint32_t seed;
  bool damaged;  ///< its inputs hold any bits now and then
  Params params;
};

std::vector<Robot> make_robots(const Params& robot);

}  // namespace verp::replay
