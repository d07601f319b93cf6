#pragma once
#include "common/gait/preview.hpp"

/// Time, phases and the queue of steps, planned while walking: at most three future steps, at most
/// two key points of the multibody correction a tick.
namespace verp::gait {

/// Digests: on a change the standing robot weighs itself again.
struct Settled {
  std::uint32_t load = 0;   ///< angles of arms and head
  std::uint32_t stand = 0;  ///< tuning and place
  bool operator==(const Settled&) const = default;
  VERP_FIELDS(load, stand)
};
VERP_PACKED(Settled);

struct GaitState {
  Step previous;       ///< for delayed joints and sensors
  Step queue[kQueue];  ///< queue[0]: the step at `clock_us`
  PreviewState preview;
  FootstepState footsteps;
  Settled settled;                ///< digests for which stand_body_m holds
  Xy stand_body_m;                ///< body position while standing, walk frame
  std::int32_t clock_us = 0;      ///< the goals' moment, since queue[0]'s start
  std::uint8_t queued = 0;        ///< steps in the queue; 0: standing
  std::uint8_t first_key = 0;     ///< fixed key point at queue[0]'s start, mod 256
  std::uint8_t previous_key = 0;  ///< the same of `previous`
  std::uint8_t moving = 0;        ///< 0: the head runs ahead before a walk
  VERP_FIELDS(previous, queue, preview, footsteps, settled, stand_body_m, clock_us, queued,
              first_key, previous_key, moving)
};
VERP_PACKED(GaitState);

struct GaitIn {
  bool walk = false;     ///< false: finish the walk, stand
  bool at_once = false;  ///< begin without looking ahead
  VelocityIn wanted;
  const float* goal_rad = nullptr;  ///< last goals of all joints, for arms and head
  std::int32_t period_us = 10000;
};

struct GaitOut {
  Posture posture;                    ///< at the goals' moment
  float carry[kFeet] = {0.5F, 0.5F};  ///< share of the weight, goals' moment
  Xy zmp_m;                           ///< planned, goals' moment
  Xy accel_m_s2;                      ///< planned, of the body, goals' moment
  Phase phase = Phase::kIdle;         ///< now: look_ahead_s before the goals' moment
  std::uint8_t swing = kBoth;         ///< foot in the air now; kBoth: none
  std::uint8_t carrying = kBoth;  ///< stance foot now, in double support the next; kBoth: standing
  std::uint8_t cycle_state = 0;   ///< 0..15, now
};

GaitOut update(const Params& params, const Tuning& tuning, GaitState& state, const GaitIn& in);

/// Posture `delay_us` before the goals' moment (GaitTuning::joint_delay_s).
Posture posture_before(const Params& params, const Tuning& tuning, const GaitState& state,
                       std::int32_t delay_us);

}  // namespace verp::gait
