#include "common/kinematics/look_at.hpp"

#include "common/math/elementary.hpp"
#include "common/math/scalar.hpp"

namespace verp::kinematics {
namespace {

/// A joint's position at zero angles, from the body's origin or ancestor joint `base`.
Vec3 place(const Params& params, int joint, int base) {
  Vec3 sum_m{0, 0, 0};
  for (int j = joint; j != base; j = params.joint[j].parent - 1) {
    sum_m += math::to_vec(params.joint[j].origin_parent_m);
    if (params.joint[j].parent == 0) break;
  }
  return sum_m;
}

}  // namespace

HeadAngles look_at(const Params& params, const Vec3& point_body_m) {
  const bool pans = params.head_pan < params.joint_count;
  const bool tilts = params.head_tilt < params.joint_count;
  HeadAngles angles;
  Vec3 ray_m = point_body_m;
  if (pans) {
    ray_m -= place(params, params.head_pan, -1);
    angles.pan_rad = math::atan2(ray_m.y(), ray_m.x());
    const math::SinCos turn = math::sincos(angles.pan_rad);
    ray_m = Vec3{turn.cos * ray_m.x() + turn.sin * ray_m.y(), 0, ray_m.z()};
  }
  if (tilts) {
    ray_m -= place(params, params.head_tilt, pans ? params.head_pan : -1);
    angles.tilt_rad = math::atan2(-ray_m.z(), ray_m.x());
  }
  return angles;
}

}  // namespace verp::kinematics
