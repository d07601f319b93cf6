#pragma once
#include "common/gait/whole_body.hpp"

/// Hips whose yaw one motor turns, both ways at once. Eleven motors cannot give both soles all
/// their twelve freedoms, so one of the trunk's is given up: its heading between the feet.
namespace verp::gait {

/// The foot whose hip yaw follows the other's motor; kBoth: none does.
int coupled_hip(const Params& params);

/// Turns the body about the vertical so that both hips' yaws are what one motor makes of them, with
/// the soles where they are. Straight ahead that is by milliradians (of a leaning trunk that sways,
/// hips yaw alike); in a turn the hips' own halves of it fit. One correction leaves errors of
/// second order. `previous_rad`: six angles of each leg, where Newton starts from.
void turn_to_hips(const Params& params, const float (&previous_rad)[kFeet][kLegJoints],
                  Posture& posture);

}  // namespace verp::gait
