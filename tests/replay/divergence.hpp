#pragma once
#include <cinttypes>
#include <cstdio>

#include "tests/replay/long_trace.hpp"

namespace verp::replay {

inline bool same(const TickDigest& a, const TickDigest& b) {
  return __builtin_memcmp(&a, &b, sizeof a) == 0;
}

/// Names the first tick and stage that differ.
inline void complain(const Segment& segment, const TickRecord& recorded, const TickDigest& now) {
  int stage = 0;
  while (stage < kStages - 1 && recorded.digest.stage[stage] == now.stage[stage]) ++stage;
  std::fprintf(stderr, "%s: first divergence: tick %" PRIu32 ", stage %s\n", segment.name.c_str(),
               recorded.inputs.tick, kStageNames[stage]);
}

}  // namespace verp::replay
