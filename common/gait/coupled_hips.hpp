#pragma once
#include "common/gait/whole_body.hpp"

/// Hips whose yaws share one motor, in opposite directions. Eleven motors cannot place both soles
/// freely, so the trunk gives up its heading between the feet.
namespace verp::gait {

/// Foot whose hip yaw is the follower; kBoth: none.
int coupled_hip(const Params& params);

/// Turns the body about the vertical so that one motor gives both yaws, soles fixed. Straight ahead
/// it turns milliradians, in turns half the turn. Second-order errors remain. `previous_rad`: six
/// angles per leg, for Newton.
void turn_to_hips(const Params& params, const float (&previous_rad)[kFeet][kLegJoints],
                  Posture& posture);

}  // namespace verp::gait
