#pragma once
#include "common/math/linear.hpp"
#include "common/model/params.hpp"

namespace verp::kinematics {

struct HeadAngles {
  float pan_rad = 0;   ///< to the left
  float tilt_rad = 0;  ///< down
};

/// Turns the head's x axis to a point, body frame. For a pan axis along z and a tilt axis along y
/// on a fixed trunk; exact if the tilt axis crosses the plane of pan axis and point. Total. Does
/// not apply limits. 0 for a missing joint and for a point on its axis.
HeadAngles look_at(const Params& params, const Vec3& point_body_m);

}  // namespace verp::kinematics
