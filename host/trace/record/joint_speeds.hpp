#pragma once
#include <array>
#include <span>

#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp::record {

/// Speeds from each joint's last two readings, because servos are not asked for speed. 0 until
/// there are two.
class JointSpeeds {
 public:
  explicit JointSpeeds(const Params& params) : params_(params) {}
  /// In the order of Params; valid until the next call.
  std::span<const double> after(const Inputs& inputs);

 private:
  Params params_;
  std::uint32_t known_ = 0;  ///< bit j: joint j was read
  std::array<std::uint32_t, kMaxJoints> tick_{};
  std::array<std::int32_t, kMaxJoints> count_{};
  std::array<double, kMaxJoints> rad_s_{};
};

}  // namespace verp::record
