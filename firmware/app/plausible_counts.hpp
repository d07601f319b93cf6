#pragma once
#include <cstdint>

#include "common/model/params.hpp"

namespace verp::app {

/// Filters positions of a protocol with a weak checksum. A joint moves at most so far in a tick; a
/// reading further away counts only if the next one confirms it (a joint that was turned by hand
/// while its servo was silent).
class PlausibleCounts {
 public:
  explicit PlausibleCounts(const Params& params) : params_(params) {}

  /// `ticks` since the joint's last reading, at least 1.
  bool counts(int joint, std::int32_t count, std::uint32_t ticks) {
    const std::int32_t most = most_counts(joint, ticks);
    const bool near_last = near(count, last_[joint], most);
    const bool confirmed = near(count, rejected_[joint], most);
    const bool good = (known_ >> joint & 1) == 0 || near_last || confirmed;
    known_ |= 1u << joint;
    if (good) last_[joint] = count;
    rejected_[joint] = good ? kNever : count;
    return good;
  }

 private:
  static constexpr std::int32_t kNever = 1 << 24;
  /// A falling robot's joints are driven faster than by their motors; an estimate.
  static constexpr float kFaster = 4;
  static constexpr std::int32_t kNoise = 16;  ///< counts
  static constexpr std::int32_t kAnywhere = 1 << 20;

  static bool near(std::int32_t a, std::int32_t b, std::int32_t most) {
    const std::int32_t apart = a < b ? b - a : a - b;
    return apart <= most;
  }
  std::int32_t most_counts(int joint, std::uint32_t ticks) const {
    const JointParams& p = params_.joint[joint];
    const float counts_per_rad = p.counts_per_rad < 0 ? -p.counts_per_rad : p.counts_per_rad;
    const float period_s = 1e-6F * static_cast<float>(params_.period_us);
    const float counts =
        kFaster * p.velocity_limit_rad_s * counts_per_rad * period_s * static_cast<float>(ticks);
    const bool any = !(counts < static_cast<float>(kAnywhere));
    return kNoise + (any ? kAnywhere : static_cast<std::int32_t>(counts));
  }

  const Params& params_;
  std::uint32_t known_ = 0;
  std::int32_t last_[kMaxJoints] = {};
  std::int32_t rejected_[kMaxJoints] = {};
};

}  // namespace verp::app
