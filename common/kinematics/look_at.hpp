#pragma once
#include "common/math/linear.hpp"
#include "common/model/params.hpp"

namespace verp::kinematics {

/// Head angles that point the head's x axis at a point in the body frame.
struct HeadAngles {
  float pan_rad = 0;   ///< to the left
  float tilt_rad = 0;  ///< down
};

/// For a head with pan axis along z and tilt axis along y on a fixed trunk; the view ray passes
/// through the tilt axis. Exact if the tilt axis crosses the plane of the pan axis and the point.
/// Total; the limiter applies joint limits. A missing joint gets angle 0, and so does a point on
/// the joint's axis.
HeadAngles look_at(const Params& params, const Vec3& point_body_m);

}  // namespace verp::kinematics
