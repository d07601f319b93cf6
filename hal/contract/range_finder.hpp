#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// RangeFinder: a rotating laser that measures distances.
///
/// A backend promises:
///  - read(scan): the newest whole scan, or why there is none. Never waits. Only kFresh changes the
///    scan. A second read of a scan is kStale.
///  - Steps count anticlockwise seen from above; the robot file gives each step's angle. All ranges
///    belong to one turn. Range 0: nothing in range, no measurement, or too far for range_mm.
///  - time_us: when the scan was measured, by the sensor's clock; it rises unless that restarts.
///  - After kFault (silent, gone, or the sensor reports a defect) later reads retry. faults()
///    counts kFault reads, modulo 2^32.
///  - No call allocates or throws.
namespace verp::hal {

inline constexpr std::size_t kMostRangeSteps = 1128;  ///< UTM-30LX and UST-10LX have 1081

struct RangeScan {
  std::uint64_t time_us = 0;
  std::size_t steps = 0;
  std::uint16_t range_mm[kMostRangeSteps] = {};  ///< the first `steps` are valid
};

enum class RangeStatus : std::uint8_t { kFresh = 0, kStale = 1, kFault = 2 };

template <class Finder>
concept RangeFinder = requires(Finder& finder, const Finder& seen, RangeScan& scan) {
  { finder.read(scan) } -> std::same_as<RangeStatus>;
  { seen.faults() } -> std::same_as<std::uint32_t>;
};

}  // namespace verp::hal
