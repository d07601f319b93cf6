#pragma once
#include "common/math/linear.hpp"
#include "common/model/params.hpp"

namespace verp::kinematics {

/// Head angles that turn the head's x axis to a point of the body frame.
struct HeadAngles {
  float pan_rad = 0;   ///< to the left
  float tilt_rad = 0;  ///< down
};

/// For a head whose pan axis is along z and whose tilt axis is along y, on a trunk that stands
/// still in the body frame; the view's ray passes through the tilt axis. Exact where the tilt axis
/// crosses the plane of the pan axis and the point. Total; joints' limits are the limiter's
/// business. A missing joint's angle is 0, and so is that of a point on its axis.
HeadAngles look_at(const Params& params, const Vec3& point_body_m);

}  // namespace verp::kinematics
