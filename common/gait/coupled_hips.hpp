#pragma once
#include "common/gait/whole_body.hpp"

/// Robots whose two hip yaws share one motor, in opposite directions. Eleven motors cannot control
/// all twelve freedoms of both soles, so the trunk's heading between the feet is given up.
namespace verp::gait {

/// The foot whose hip yaw follows the other's motor; kBoth if none.
int coupled_hip(const Params& params);

/// Turns the body about the vertical so that one motor gives both hip yaws, with the soles fixed.
/// Walking straight this takes milliradians (both hips yaw alike as a leaning trunk sways); in a
/// turn each hip takes its half. One correction leaves second-order errors. `previous_rad`: six
/// angles of each leg, for Newton's warm start.
void turn_to_hips(const Params& params, const float (&previous_rad)[kFeet][kLegJoints],
                  Posture& posture);

}  // namespace verp::gait
