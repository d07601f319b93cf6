#pragma once
#include "common/gait/types.hpp"

/// The linear inverted pendulum under a piecewise-linear ZMP, in closed form. omega = sqrt(g / CoM
/// height), 1/s. The DCM xi = x + x' / omega obeys xi' = omega (xi - zmp): plan it backwards from
/// its end. The CoM follows by x' = omega (xi - x).
namespace verp::gait {

/// ZMP `time_s` after the step's start.
Xy zmp_at(const Step& step, float time_s);

/// DCM `time_s` after the step's start, from step.dcm_end_m.
Xy dcm_at(const Step& step, float omega, float time_s);

/// CoM at to_s from the CoM at from_s; from_s <= to_s, in the step.
Xy com_after(const Step& step, float omega, Xy com_m, float from_s, float to_s);

/// DCM at the end of the last known step if the ZMP displacements `next_m` and `second_m` alternate
/// forever.
Xy periodic_dcm(const Step& last, Xy next_m, Xy second_m, float omega);

}  // namespace verp::gait
