#pragma once
#include "common/gait/swing.hpp"
#include "common/model/params.hpp"
#include "tests/unit/gait/steps.hpp"

namespace verp::gait::test {

struct Corners {
  Xy at[4];
};

inline Corners corners_of(const LegParams& leg, const Foothold& foot) {
  const Xy in_sole[4] = {{leg.sole_front_m, leg.sole_left_m},
                         {-leg.sole_back_m, leg.sole_left_m},
                         {-leg.sole_back_m, -leg.sole_right_m},
                         {leg.sole_front_m, -leg.sole_right_m}};
  Corners corners;
  for (int i = 0; i < 4; ++i) corners.at[i] = foot.at_m + turned(in_sole[i], foot.yaw_rad);
  return corners;
}

// Separating axis: the largest distance that any side gives.
inline float apart_m(const Corners& a, const Corners& b) {
  float most_m = -1;
  for (int shape = 0; shape < 2; ++shape) {
    const Corners &own = shape == 0 ? a : b, &other = shape == 0 ? b : a;
    for (int i = 0; i < 4; ++i) {
      const Xy side = own.at[(i + 1) % 4] - own.at[i];
      const Xy out = (1.0F / math::hypot(side.x, side.y)) * Xy{side.y, -side.x};
      float least_m = 1;
      for (const Xy& corner : other.at) least_m = math::min(least_m, dot(corner - own.at[i], out));
      most_m = math::max(most_m, least_m);
    }
  }
  return most_m;
}

// Every 4 ms of the swing.
inline float least_apart_m(const Params& params, const Step& step) {
  constexpr std::int32_t kTick_us = 4000;
  float least_m = 1;
  for (std::int32_t time_us = 0; time_us < step.duration_us() + kTick_us; time_us += kTick_us) {
    const float time_s = 1e-6F * static_cast<float>(time_us);
    least_m = math::min(least_m,
                        apart_m(corners_of(params.leg[kLeft], foot_at(step, kLeft, time_s).on),
                                corners_of(params.leg[kRight], foot_at(step, kRight, time_s).on)));
  }
  return least_m;
}

inline VelocityIn any_order(Random& random) {
  return {.vx_m_s = random.between(-0.8F, 0.8F),
          .vy_m_s = random.between(-0.5F, 0.5F),
          .wz_rad_s = random.between(-4, 4),
          .heading_error_rad = random.between(-1, 1)};
}

/// Random orders of one to a dozen steps.
inline float least_apart_of_jumps_m(const Params& params, const GaitTuning& tuning,
                                    std::uint32_t seed, int orders) {
  Random random(seed);
  FootstepState state;
  Step last = first_step(params, tuning, state);
  float least_m = 1;
  for (int i = 0; i < orders; ++i) {
    VelocityIn wanted = any_order(random);
    if (i % 5 == 0) wanted.wz_rad_s = random.below(2) == 0 ? 4.0F : -4.0F;
    if (i % 7 == 0) wanted.vy_m_s = 0;
    wanted.stop = i % 11 == 0;
    for (int steps = random.below(12); steps >= 0; --steps) {
      last = last.ends_walk() ? first_step(params, tuning, state)
                              : next_step(params, tuning, wanted, last, state);
      least_m = math::min(least_m, least_apart_m(params, last));
    }
  }
  return least_m;
}

}  // namespace verp::gait::test
