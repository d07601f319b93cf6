#pragma once
#include "common/control/state.hpp"
#include "host/apps/demos/brain/pose.hpp"

namespace verp::brain {

/// Where a robot thinks that it is: what its controller estimates and tells on the operator link
/// (common/balance/estimator.hpp), and where its parts then are. It drifts, and does not notice.
class Odometry {
 public:
  /// The parameters must outlive it.
  explicit Odometry(const Params& params) : params_(params) {}

  void update(const Inputs& inputs, const State& state);
  const Pose& pose() const { return pose_; }
  double roll_rad() const { return roll_rad_; }
  double pitch_rad() const { return pitch_rad_; }

  /// A point of that node's frame, and its axes, above the point of the floor that `pose` has: x
  /// ahead, z up. By the joints' angles as read last.
  const math::Pose& above_floor(int node) const { return node_[node]; }

 private:
  const Params& params_;
  Pose pose_;
  double roll_rad_ = 0, pitch_rad_ = 0;
  math::Pose node_[kMaxNodes];
};

}  // namespace verp::brain
