#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "common/record/tick_record.hpp"

/// The long trace: recorded runs of several robots that together reach every phase of the gait,
/// every row of the safety table and every branch of step() that an input can reach. What is not
/// reached stands in unreached.txt, with the reason.
namespace verp::replay {

/// The runs' names, robots and lengths are fixed; the inputs follow from the controller's own
/// outputs, as a robot's would, and from integers.
struct Segment {
  std::string name;
  Params params;
  std::vector<TickRecord> ticks;

  std::uint64_t digest() const { return ticks.back().digest.chain; }
};

inline constexpr std::uint32_t kLongTraceTicks = 100'000;

/// `robot` has closed-form legs; the other robots are made from it. `ticks` is the sum over all
/// segments: each gets its share.
std::vector<Segment> make_long_trace(const Params& robot, std::uint32_t ticks = kLongTraceTicks);

/// One number for all segments.
std::uint64_t digest_of(const std::vector<Segment>& trace);

}  // namespace verp::replay
