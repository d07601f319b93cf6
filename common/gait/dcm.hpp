#pragma once
#include "common/gait/types.hpp"

/// The linear inverted pendulum under a piecewise-linear ZMP, in closed form. omega = sqrt(g / CoM
/// height), 1/s. The divergent component of motion (DCM) is xi = x + x' / omega; it obeys xi' =
/// omega (xi - zmp), so a plan is made backwards from where it must end; the CoM follows it
/// forwards by x' = omega (xi - x).
namespace verp::gait {

/// ZMP at `time_s` after the beginning of the step.
Xy zmp_at(const Step& step, float time_s);

/// DCM at `time_s` after the beginning of the step, from step.dcm_end_m.
Xy dcm_at(const Step& step, float omega, float time_s);

/// CoM at to_s, given the CoM at from_s; both within the step, from_s <= to_s.
Xy com_after(const Step& step, float omega, Xy com_m, float from_s, float to_s);

/// DCM at the end of the last known step when walking goes on after it for ever in the same way:
/// `next_m` and `second_m` are the ZMP displacements of the two steps that follow, and they
/// alternate.
Xy periodic_dcm(const Step& last, Xy next_m, Xy second_m, float omega);

}  // namespace verp::gait
