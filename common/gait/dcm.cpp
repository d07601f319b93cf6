#include "common/gait/dcm.hpp"

namespace verp::gait {
namespace {

// Velocity of the ZMP; 0 without double support, where it jumps.
Xy zmp_velocity(const Step& step) {
  return step.double_support_s > 0.0F
             ? (1.0F / step.double_support_s) * (step.zmp_end_m - step.zmp_begin_m)
             : Xy{};
}

// CoM after a time with zmp = p + v t, from CoM x and DCM xi at t = 0:
// x = p + v t + a e^(wt) + b e^(-wt), xi = p + v t + v/w + 2 a e^(wt).
Xy advance(Xy x, Xy xi, Xy p, Xy v, float omega, float time_s) {
  const float grow = math::exp(omega * time_s);
  const float shrink = 1.0F / grow;
  const Xy a = 0.5F * (xi - p - (1.0F / omega) * v);
  const Xy b = x - p - a;
  return p + time_s * v + grow * a + shrink * b;
}

}  // namespace

Xy zmp_at(const Step& step, float time_s) {
  if (time_s >= step.double_support_s) return step.zmp_end_m;
  return step.zmp_begin_m + math::max(time_s, 0.0F) * zmp_velocity(step);
}

Xy dcm_at(const Step& step, float omega, float time_s) {
  const float rest_s = math::max(time_s, step.double_support_s);
  const Xy resting = step.zmp_end_m + math::exp(omega * (rest_s - step.duration_s())) *
                                          (step.dcm_end_m - step.zmp_end_m);
  if (time_s >= step.double_support_s) return resting;
  const Xy lead = (1.0F / omega) * zmp_velocity(step);
  return zmp_at(step, time_s) + lead +
         math::exp(omega * (time_s - step.double_support_s)) * (resting - step.zmp_end_m - lead);
}

Xy com_after(const Step& step, float omega, Xy com_m, float from_s, float to_s) {
  const float moved_s = math::clamp(step.double_support_s, from_s, to_s);
  Xy x = com_m;
  if (moved_s > from_s) {
    x = advance(x, dcm_at(step, omega, from_s), zmp_at(step, from_s), zmp_velocity(step), omega,
                moved_s - from_s);
  }
  if (to_s > moved_s) {
    x = advance(x, dcm_at(step, omega, moved_s), step.zmp_end_m, Xy{}, omega, to_s - moved_s);
  }
  return x;
}

Xy periodic_dcm(const Step& last, Xy next_m, Xy second_m, float omega) {
  // s, the DCM's lead over the ZMP at a step's end, repeats after two steps: s = g d1 + a (g d2 + a
  // s). Double support scales the displacement by g.
  const float a = math::exp(-omega * last.duration_s());
  const float ramp = omega * last.double_support_s;
  const float g = ramp > 1e-3F ? (1.0F - math::exp(-ramp)) / ramp : 1.0F;
  return last.zmp_end_m + (g / (1.0F - a * a)) * (next_m + a * second_m);
}

}  // namespace verp::gait
