#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "common/record/tick_record.hpp"

/// Runs of several robots that together reach step()'s branches, but those of unreached.txt.
namespace verp::replay {

struct Segment {
  std::string name;
  Params params;
  std::vector<TickRecord> ticks;

  std::uint64_t digest() const { return ticks.back().digest.chain; }
};

inline constexpr std::uint32_t kLongTraceTicks = 100'000;

/// `robot` has closed-form legs; the others derive from it. `ticks` is the sum over all segments.
std::vector<Segment> make_long_trace(const Params& robot, std::uint32_t ticks = kLongTraceTicks);

std::uint64_t digest_of(const std::vector<Segment>& trace);

}  // namespace verp::replay
