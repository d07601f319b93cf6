#pragma once
#include "common/model/params.hpp"
#include "common/safety/machine.hpp"

namespace verp::safety {

/// No torque if a joint is further beyond its limits: this bounds the first jump. Less than the
/// fastest joint moves in a tick of a walk (8 rad/s, 10 ms); more than a sagging joint presses into
/// its stop.
inline constexpr float kBeyond_rad = 0.05F;

struct LimitState {
  float goal_rad[kMaxJoints] = {};  ///< last goals sent
  VERP_FIELDS(goal_rad)
};
VERP_PACKED(LimitState);

struct LimitIn {
  Mode mode = Mode::kRelaxed;
  std::int32_t in_mode_us = 0;
  std::uint16_t way_ms = 0;           ///< from the previous LimitOut, while rising or sitting
  const float* wanted_rad = nullptr;  ///< joint_count goals of the gait
  const std::int32_t* position_count = nullptr;  ///< last reported
  const SafetyTuning* tuning = nullptr;
};

struct LimitOut {
  bool slowed = false;       ///< a speed limit took effect, standing or walking
  bool beyond = false;       ///< torque is off and joint_beyond() names a joint
  std::uint16_t way_ms = 0;  ///< duration of the way, computed in the first tick
};

/// First joint beyond its limits by more than kBeyond_rad; kMaxJoints: none.
int joint_beyond(const Params& params, const std::int32_t* position_count);

/// Sets state.goal_rad. Rising and sitting last rise_s and sit_s, or longer for a joint's speed
/// limit.
LimitOut limit(const Params& params, LimitState& state, const LimitIn& in);

}  // namespace verp::safety
