#pragma once
#include "common/model/params.hpp"
#include "common/safety/machine.hpp"

/// The last word on every goal: joint limits, joint speeds, and what the mode allows.
namespace verp::safety {

struct LimitState {
  float goal_rad[kMaxJoints] = {};  ///< sent last
  VERP_FIELDS(goal_rad)
};
VERP_PACKED(LimitState);

struct LimitIn {
  Mode mode = Mode::kRelaxed;
  std::int32_t in_mode_us = 0;
  const float* wanted_rad = nullptr;             ///< by the gait, joint_count of them
  const std::int32_t* position_count = nullptr;  ///< where the joints are, as last reported
  const SafetyTuning* tuning = nullptr;
};

/// Sets state.goal_rad for this tick. Returns true when a speed limit took effect while standing or
/// walking.
bool limit(const Params& params, LimitState& state, const LimitIn& in);

}  // namespace verp::safety
