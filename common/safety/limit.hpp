#pragma once
#include "common/model/params.hpp"
#include "common/safety/machine.hpp"

/// The last word on every goal: joint limits, joint speeds, and what the mode allows.
namespace verp::safety {

/// What a joint may be beyond its limits and torque still come: the goal is never beyond, so this
/// is how far the joint is thrown. Less than the fastest one moves in a tick of a walk (8 rad/s, 10
/// ms); more than a sagging joint is pressed into its stop.
inline constexpr float kBeyond_rad = 0.05F;

struct LimitState {
  float goal_rad[kMaxJoints] = {};  ///< sent last
  VERP_FIELDS(goal_rad)
};
VERP_PACKED(LimitState);

struct LimitIn {
  Mode mode = Mode::kRelaxed;
  std::int32_t in_mode_us = 0;
  std::uint16_t way_ms = 0;           ///< as the tick before found, while rising and sitting down
  const float* wanted_rad = nullptr;  ///< by the gait, joint_count of them
  const std::int32_t* position_count = nullptr;  ///< where the joints are, as last reported
  const SafetyTuning* tuning = nullptr;
};

struct LimitOut {
  bool slowed = false;       ///< a speed limit took effect while standing or walking
  bool beyond = false;       ///< without torque, and joint_beyond() names one
  std::uint16_t way_ms = 0;  ///< LimitIn's, or, in the first tick, how long the way takes
};

/// The first joint that is further beyond its limits than kBeyond_rad; kMaxJoints: none.
int joint_beyond(const Params& params, const std::int32_t* position_count);

/// Sets state.goal_rad for this tick. A rise or sitting down lasts rise_s or sit_s, or for as long
/// as its longest way takes at the joint's speed limit.
LimitOut limit(const Params& params, LimitState& state, const LimitIn& in);

}  // namespace verp::safety
