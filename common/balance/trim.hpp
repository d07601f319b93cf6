#pragma once
#include "common/balance/attitude.hpp"
#include "common/balance/feedback.hpp"
#include "common/io/io.hpp"

/// Joint zeros are never exact. Half a degree at an ankle moves the ZMP by a centimetre, so each
/// leg learns, while it carries alone, small angles that bring the pressure under its sole back to
/// where the plan wants it and the body upright: the ankle from the foot sensors, the hip from the
/// tilt.
namespace verp::balance {

struct TrimState {
  LegCorrection leg[kFeet];
  VERP_FIELDS(leg)
};
VERP_PACKED(TrimState);

inline constexpr float kMaxTrim_rad =
    0.03F;  ///< three times a servo's assembly error of half a degree

struct TrimIn {
  bool feet_fresh = false;
  const std::uint16_t* foot_count = nullptr;  ///< kFootSensors of the carrying foot
  int carrying = 0;                           ///< the foot that carries alone
  float planned_pitch_rad = 0;
  float period_s = 0.01F;
};

/// Learns from one tick in which one foot carries alone.
void learn(const Params& params, const Tuning& tuning, const AttitudeOut& attitude,
           const TrimIn& in, TrimState& state);

/// Centre of pressure from the sole's centroid, as a share of the half length (x) and half width
/// (y), each in
/// [-1, 1]; 0 without load. Sensors stand at the sole's corners.
gait::Xy pressure_center(const std::uint16_t* foot_count);

}  // namespace verp::balance
