#pragma once
#include <cstdint>

#include "common/math/convert.hpp"
#include "common/model/params.hpp"
#include "common/safety/machine.hpp"

namespace verp::app {

constexpr std::uint32_t all_joints(const Params& params) {
  return params.servo_count() >= kMaxJoints ? ~0u : (1u << params.servo_count()) - 1;
}

/// A servo silent for this long may have lost its power: its processor takes longer than
/// kLongest_us to start.
inline std::uint32_t doubt_us(const Params& params) {
  constexpr std::uint32_t kLongest_us = 50'000;
  const auto hold_us =
      static_cast<std::uint32_t>(math::to_int32(1e6F * params.tuning.safety.stale_hold_s));
  return hold_us < kLongest_us ? hold_us : kLongest_us;
}

class JointStrength {
 public:
  explicit JointStrength(const Params& params) : params_(params) {}

  /// 100 % of each joint, in its servo's units.
  void set_full(const std::uint16_t (&full)[kMaxJoints]) {
    for (int j = 0; j < kMaxJoints; ++j) full_[j] = full[j];
  }
  void limit_torque(std::uint8_t percent) { most_percent_ = percent; }

 protected:
  // A robot that rises or lies down may touch anything, a hand too, and a falling one may strike
  // it. Then servos push no harder than the entity's rise_torque_percent.
  std::uint8_t percent_in(std::uint8_t mode) const {
    const auto is = [mode](safety::Mode each) { return mode == static_cast<std::uint8_t>(each); };
    const bool gives_way =
        is(safety::Mode::kRising) || is(safety::Mode::kFalling) || is(safety::Mode::kLyingDown);
    return gives_way && params_.rise_torque_percent < most_percent_ ? params_.rise_torque_percent
                                                                    : most_percent_;
  }
  std::uint16_t strength_of(int joint, std::uint8_t percent) const {
    return static_cast<std::uint16_t>(full_[joint] * percent / 100);
  }

  const Params& params_;

 private:
  std::uint8_t most_percent_ = 100;
  std::uint16_t full_[kMaxJoints] = {};
};

}  // namespace verp::app
