#pragma once
#include "common/control/state.hpp"
#include "common/kinematics/forward.hpp"
#include "host/demos/brain/pose.hpp"

namespace verp::brain {

/// Where a robot thinks that it is, from what its controller tells of each tick: the foot that
/// carries stands still, so the trunk moves by what the leg's joints say; which way, the gyro says.
/// Soles that slip and a gyro that drifts are not noticed.
class Odometry {
 public:
  /// The parameters must outlive it.
  explicit Odometry(const Params& params) : params_(params) {}

  void update(const Inputs& inputs, const State& state, const Outputs& outputs);
  const Pose& pose() const { return pose_; }
  double roll_rad() const { return roll_rad_; }
  double pitch_rad() const { return pitch_rad_; }

  /// A point of that node's frame, and its axes, above the floor below the trunk's centre: x ahead,
  /// z up. By the joints' angles as read last.
  math::Pose above_floor(int node) const;

 private:
  const Params& params_;
  Pose pose_;
  double roll_rad_ = 0, pitch_rad_ = 0;
  math::Pose node_[kMaxNodes];  ///< trunk upright by the IMU, its centre at 0
  Point sole_m_[kFeet];         ///< of the tick before, in `pose_`
  double floor_m_ = 0;          ///< of the sole that carries, seen from the trunk's centre
  int carrying_ = 0;
  bool begun_ = false;
};

}  // namespace verp::brain
