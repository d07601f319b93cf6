#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hal/contract/range_finder.hpp"
#include "host/twin/sim/robot.hpp"

namespace verp::sim {

/// A twin's laser as hal/contract/range_finder.hpp. It takes all scans: those of other lasers are
/// lost.
class TwinRangeFinder {
 public:
  TwinRangeFinder(TwinRobot& twin, std::size_t laser) : twin_(twin), laser_(laser) {}

  hal::RangeStatus read(hal::RangeScan& scan) {
    bool fresh = false;
    for (const Scan& taken : twin_.take_scans()) {
      if (taken.laser != laser_) continue;
      scan.time_us = taken.time_us;
      scan.steps = std::min(taken.range_m.size(), hal::kMostRangeSteps);
      for (std::size_t i = 0; i < scan.steps; ++i) scan.range_mm[i] = in_mm(taken.range_m[i]);
      fresh = true;
    }
    return fresh ? hal::RangeStatus::kFresh : hal::RangeStatus::kStale;
  }
  /// It is never silent.
  std::uint32_t faults() const { return 0; }

 private:
  static std::uint16_t in_mm(float range_m) {
    const float range_mm = 1000 * range_m;
    return range_mm < 65535.5F ? static_cast<std::uint16_t>(std::lround(range_mm))
                               : std::uint16_t{0};
  }

  TwinRobot& twin_;
  const std::size_t laser_;
};

static_assert(hal::RangeFinder<TwinRangeFinder>);

}  // namespace verp::sim
