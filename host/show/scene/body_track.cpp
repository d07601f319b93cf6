#include "host/show/scene/body_track.hpp"

#include <algorithm>

#include "host/show/scene/measured.hpp"
#include "host/twin/sim/body.hpp"

namespace verp::scene {
Transform to_transform(const record::ros::BodyPose& pose) {
  const auto& [x, y, z, w] = pose.orientation_xyzw;
  Transform out(Eigen::Quaterniond(w, x, y, z).normalized());
  out.translation() = Vec3(pose.position_m[0], pose.position_m[1], pose.position_m[2]);
  return out;
}

Transform between(const Transform& from, const Transform& to, double part) {
  Transform out(Eigen::Quaterniond(from.linear()).slerp(part, Eigen::Quaterniond(to.linear())));
  out.translation() = (1 - part) * from.translation() + part * to.translation();
  return out;
}

std::vector<Transform> TickPoses::operator()(const Inputs& inputs, const Transform& body) const {
  return sim::link_poses(entity_, body, measured_rad(inputs, params_));
}

Transform BodyTrack::at(std::size_t index, const State& state, const Outputs& outputs) {
  if (!trace_.bodies.empty()) return between(index);
  return by_feet(trace_.ticks[index].inputs, state, outputs);
}

Transform BodyTrack::between(std::size_t index) {
  const auto& bodies = trace_.bodies;
  while (next_ < bodies.size() && bodies[next_].index <= index) ++next_;
  if (next_ == 0) return to_transform(bodies.front().pose);
  if (next_ == bodies.size()) return to_transform(bodies.back().pose);
  const record::BodyAt &a = bodies[next_ - 1], &b = bodies[next_];
  const double share =
      static_cast<double>(index - a.index) / static_cast<double>(b.index - a.index);
  return scene::between(to_transform(a.pose), to_transform(b.pose), share);
}

Transform BodyTrack::by_feet(const Inputs& inputs, const State& state, const Outputs& outputs) {
  const double roll_rad = outputs.tilt_tenth_mrad[0] * 1e-4,
               pitch_rad = outputs.tilt_tenth_mrad[1] * 1e-4;
  Transform body(Eigen::AngleAxisd(static_cast<double>(state.attitude.heading_rad), Vec3::UnitZ()) *
                 Eigen::AngleAxisd(pitch_rad, Vec3::UnitY()) *
                 Eigen::AngleAxisd(roll_rad, Vec3::UnitX()));
  RobotView view;
  view.link_world = poses_(inputs, body);
  const sim::Truth feet = soles_of(view, poses_.entity());
  if (!feet.foot[0].present || !feet.foot[1].present) {
    body.translation().z() = 0.3;
    return body;
  }
  const int low = feet.foot[0].centroid_world_m.z() <= feet.foot[1].centroid_world_m.z() ? 0 : 1;
  if (standing_ < 0) standing_ = low;  // the first foot to stand is at the origin
  const auto seen_m = [&](int side) {
    return Vec2(feet.foot[static_cast<std::size_t>(side)].centroid_world_m.head<2>());
  };
  Vec2 shift_m = stands_m_ - seen_m(standing_);
  if (low != standing_) {  // weight moves over
    standing_ = low;
    stands_m_ = seen_m(low) + shift_m;
  }
  shift_m = stands_m_ - seen_m(standing_);
  body.translation() << shift_m, -feet.foot[static_cast<std::size_t>(low)].centroid_world_m.z();
  return body;
}

}  // namespace verp::scene
