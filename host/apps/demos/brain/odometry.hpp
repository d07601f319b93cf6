#pragma once
#include "common/control/state.hpp"
#include "host/apps/demos/brain/pose.hpp"

namespace verp::brain {

/// The robot's own pose estimate from its controller's state (common/balance/estimator.hpp), and
/// the poses of its links. It drifts without noticing.
class Odometry {
 public:
  /// The caller keeps `params` alive.
  explicit Odometry(const Params& params) : params_(params) {}

  void update(const Inputs& inputs, const State& state);
  const Pose& pose() const { return pose_; }
  double roll_rad() const { return roll_rad_; }
  double pitch_rad() const { return pitch_rad_; }

  /// Pose of a node's frame above the floor point of `pose` (x ahead, z up), from the last joint
  /// angles.
  const math::Pose& above_floor(int node) const { return node_[node]; }

 private:
  const Params& params_;
  Pose pose_;
  double roll_rad_ = 0, pitch_rad_ = 0;
  math::Pose node_[kMaxNodes];
};

}  // namespace verp::brain
