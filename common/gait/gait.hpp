#pragma once
#include "common/gait/preview.hpp"

/// The gait engine: time, phases and the queue of steps. Everything is planned while walking; at
/// most three future steps are known, and at most two key points of the multibody correction are
/// worked in one tick.
namespace verp::gait {

/// Digests of all that the place of a standing body follows from: a robot that stands weighs itself
/// anew when one of them changes.
struct Settled {
  std::uint32_t load = 0;   ///< angles of arms and head
  std::uint32_t stand = 0;  ///< tuning, and the place itself
  bool operator==(const Settled&) const = default;
  VERP_FIELDS(load, stand)
};
VERP_PACKED(Settled);

struct GaitState {
  Step previous;       ///< kept for joints and sensors that look back
  Step queue[kQueue];  ///< queue[0] is the step at `clock_us`
  PreviewState preview;
  FootstepState footsteps;
  Settled settled;                ///< what stand_body_m is right for
  Xy stand_body_m;                ///< body while standing, walk frame
  std::int32_t clock_us = 0;      ///< since the beginning of queue[0]; goals are for this moment
  std::uint8_t queued = 0;        ///< steps in the queue; 0: standing
  std::uint8_t first_key = 0;     ///< fixed key point at the beginning of queue[0], mod 256
  std::uint8_t previous_key = 0;  ///< likewise of `previous`
  std::uint8_t moving = 0;        ///< 0 while the head runs ahead before the first step
  VERP_FIELDS(previous, queue, preview, footsteps, settled, stand_body_m, clock_us, queued,
              first_key, previous_key, moving)
};
VERP_PACKED(GaitState);

struct GaitIn {
  bool walk = false;     ///< false: finish the walk, then stand
  bool at_once = false;  ///< a robot that stands begins without a look ahead
  VelocityIn wanted;
  const float* goal_rad = nullptr;  ///< last goals, joint_count of them: where arms and head are
  std::int32_t period_us = 10000;
};

struct GaitOut {
  Posture posture;                    ///< wanted at the goals' moment
  float carry[kFeet] = {0.5F, 0.5F};  ///< share of the weight on each foot at the goals' moment
  Xy zmp_m;                           ///< planned, at the goals' moment
  Xy accel_m_s2;                      ///< of the body, planned, at the goals' moment
  Phase phase = Phase::kIdle;         ///< now, that is look_ahead_s before the goals' moment
  std::uint8_t swing = kBoth;         ///< foot in the air now; kBoth: none
  std::uint8_t carrying =
      kBoth;  ///< foot that carries now, or in double support is about to; kBoth: standing
  std::uint8_t cycle_state = 0;  ///< 0..15, now
};

GaitOut update(const Params& params, const Tuning& tuning, GaitState& state, const GaitIn& in);

/// Posture `delay_us` before the goals' moment: for joints whose goals lag behind
/// (GaitTuning::joint_delay_s).
Posture posture_before(const Params& params, const Tuning& tuning, const GaitState& state,
                       std::int32_t delay_us);

}  // namespace verp::gait
