#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/imu.hpp"

/// An Imu that plays a script: samples, and reads in which the chip fails.
namespace verp::hal {

class ScriptedImu {
 public:
  /// The chip has a new sample; one that nobody fetched is gone. False: not newer than the last.
  bool measure(const ImuSample& sample) {
    if (measured_ && sample.time_us <= sample_.time_us) return false;
    sample_ = sample;
    measured_ = true;
    fetched_ = false;
    return true;
  }
  /// The chip is silent in the next `reads` reads.
  void fail(std::uint32_t reads) { failures_left_ = reads; }

  ImuStatus read(ImuSample& sample) {
    if (failures_left_ > 0) {
      --failures_left_;
      ++faults_;
      return ImuStatus::kFault;
    }
    if (!measured_ || fetched_) return ImuStatus::kStale;
    fetched_ = true;
    sample = sample_;
    return ImuStatus::kFresh;
  }
  std::uint32_t faults() const { return faults_; }

 private:
  ImuSample sample_;
  std::uint32_t failures_left_ = 0;
  std::uint32_t faults_ = 0;
  bool measured_ = false;
  bool fetched_ = false;
};

static_assert(Imu<ScriptedImu>);

}  // namespace verp::hal
