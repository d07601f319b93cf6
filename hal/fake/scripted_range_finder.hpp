#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/range_finder.hpp"

/// A RangeFinder that plays a script: scans, and reads in which the sensor is silent.
namespace verp::hal {

class ScriptedRangeFinder {
 public:
  /// It has a new scan; one that nobody fetched is gone.
  void measure(const RangeScan& scan) {
    scan_ = scan;
    fetched_ = false;
  }
  /// It is silent in the next `reads` reads.
  void fail(std::uint32_t reads) { failures_left_ = reads; }

  RangeStatus read(RangeScan& scan) {
    if (failures_left_ > 0) {
      --failures_left_;
      ++faults_;
      return RangeStatus::kFault;
    }
    if (fetched_) return RangeStatus::kStale;
    fetched_ = true;
    scan = scan_;
    return RangeStatus::kFresh;
  }
  std::uint32_t faults() const { return faults_; }

 private:
  RangeScan scan_;
  std::uint32_t failures_left_ = 0;
  std::uint32_t faults_ = 0;
  bool fetched_ = true;
};

static_assert(RangeFinder<ScriptedRangeFinder>);

}  // namespace verp::hal
