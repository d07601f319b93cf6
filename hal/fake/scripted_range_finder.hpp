#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/range_finder.hpp"

/// A RangeFinder that plays a script of scans and faults.
namespace verp::hal {

class ScriptedRangeFinder {
 public:
  void measure(const RangeScan& scan) {
    scan_ = scan;
    fetched_ = false;
  }
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
