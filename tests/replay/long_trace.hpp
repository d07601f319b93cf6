#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "common/record/tick_record.hpp"

/// Recorded runs of several robots that together reach every gait phase, safety row and branch of
/// step() that inputs can reach. unreached.txt lists the rest with reasons.
namespace verp::replay {

/// Inputs follow from the controller's own outputs, as a robot's would, and from integers.
struct Segment {
  std::string name;
  Params params;
  std::vector<TickRecord> ticks;

  std::uint64_t digest() const { return ticks.back().digest.chain; }
};

inline constexpr std::uint32_t kLongTraceTicks = 100'000;

/// `robot` has closed-form legs; the other robots derive from it. `ticks` is the sum over all
/// segments.
std::vector<Segment> make_long_trace(const Params& robot, std::uint32_t ticks = kLongTraceTicks);

/// One number for all segments.
std::uint64_t digest_of(const std::vector<Segment>& trace);

}  // namespace verp::replay
