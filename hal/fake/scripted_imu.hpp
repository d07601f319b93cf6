#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/imu.hpp"

/// An Imu that plays a script of samples and faults.
namespace verp::hal {

class ScriptedImu {
 public:
  /// Adds a sample. False: it is not newer than the last.
  bool measure(const ImuSample& sample) {
    if (measured_ && sample.time_us <= newest_us_) return false;
    mean_.add(sample);
    newest_us_ = sample.time_us;
    measured_ = true;
    return true;
  }
  void fail(std::uint32_t reads) { failures_left_ = reads; }

  ImuStatus read(ImuSample& sample) {
    if (failures_left_ > 0) {
      --failures_left_;
      ++faults_;
      return ImuStatus::kFault;
    }
    if (!mean_.take(sample)) return ImuStatus::kStale;
    sample.time_us = newest_us_;
    return ImuStatus::kFresh;
  }
  std::uint32_t faults() const { return faults_; }

 private:
  ImuMean mean_;
  std::uint64_t newest_us_ = 0;
  std::uint32_t failures_left_ = 0;
  std::uint32_t faults_ = 0;
  bool measured_ = false;
};

static_assert(Imu<ScriptedImu>);

}  // namespace verp::hal
