#pragma once
#include "common/gait/whole_body.hpp"

/// Hips whose yaws share one motor, in opposite directions. Eleven motors cannot give both soles
/// twelve freedoms, so the trunk gives up its heading between the feet.
namespace verp::gait {

/// Foot whose hip yaw follows the other's motor; kBoth: none.
int coupled_hip(const Params& params);

/// Turns the body about the vertical so that one motor gives both yaws, with the soles fixed: by
/// milliradians straight ahead (a leaning, swaying trunk yaws both hips alike), by half the turn in
/// turns. Errors of second order remain. `previous_rad`: six angles per leg, for Newton.
void turn_to_hips(const Params& params, const float (&previous_rad)[kFeet][kLegJoints],
                  Posture& posture);

}  // namespace verp::gait
