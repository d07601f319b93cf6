#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// RangeFinder: a laser that turns and measures how far away the next thing is, step by step.
///
/// Promises of a backend:
///  - read(scan): the newest whole scan, or says why there is none. Never waits. Only kFresh
///    changes the scan, and no scan is given twice: the second read of it is kStale.
///  - Steps count against the clock's sense seen from above, as angles do; which angle a step has
///    is the robot's file's to say. All ranges are of one turn. 0: nothing within range there, or
///    no measurement. What is farther than range_mm holds is 0 too.
///  - time_us is when the scan was measured, by the sensor's own clock, and rises from scan to scan
///    but where the sensor starts anew.
///  - After kFault (silent, gone, or it says that it is ill) the backend tries again by itself in
///    later reads. faults() counts the reads that said so, modulo 2^32.
///  - No call allocates or throws.
/// Implementations: hal/fake/scripted_range_finder.hpp, host/link/scip_range_finder.hpp (SCIP 2.0),
/// host/sim/twin_range_finder.hpp (the twin's). User: host/tool/laser_command.cpp.
namespace verp::hal {

inline constexpr std::size_t kMostRangeSteps = 1128;  ///< UTM-30LX has 1081, UST-10LX too

struct RangeScan {
  std::uint64_t time_us = 0;
  std::size_t steps = 0;
  std::uint16_t range_mm[kMostRangeSteps] = {};  ///< the first `steps`
};

enum class RangeStatus : std::uint8_t { kFresh = 0, kStale = 1, kFault = 2 };

template <class Finder>
concept RangeFinder = requires(Finder& finder, const Finder& seen, RangeScan& scan) {
  { finder.read(scan) } -> std::same_as<RangeStatus>;
  { seen.faults() } -> std::same_as<std::uint32_t>;
};

}  // namespace verp::hal
