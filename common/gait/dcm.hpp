#pragma once
#include "common/gait/types.hpp"

/// The linear inverted pendulum under a piecewise-linear ZMP, in closed form. omega = sqrt(g / CoM
/// height), 1/s. The divergent component of motion (DCM) is xi = x + x' / omega. It obeys xi' =
/// omega (xi - zmp), so a plan is computed backwards from its end; the CoM follows forwards by x' =
/// omega (xi - x).
namespace verp::gait {

/// ZMP at `time_s` after the step's beginning.
Xy zmp_at(const Step& step, float time_s);

/// DCM at `time_s` after the step's beginning, from step.dcm_end_m.
Xy dcm_at(const Step& step, float omega, float time_s);

/// CoM at to_s, given the CoM at from_s. Both times lie within the step, from_s <= to_s.
Xy com_after(const Step& step, float omega, Xy com_m, float from_s, float to_s);

/// DCM at the end of the last known step if the walk then repeats forever: `next_m` and `second_m`
/// are the ZMP displacements of the next two steps and alternate.
Xy periodic_dcm(const Step& last, Xy next_m, Xy second_m, float omega);

}  // namespace verp::gait
