#pragma once
#include <Eigen/Core>

#include "host/apps/demos/brain/pose.hpp"

namespace verp::brain {

/// A robot's pose in a frame shared with others: odometry corrected by sightings of objects with
/// known positions (an extended Kalman filter with three states).
class Estimate {
 public:
  /// Start pose and its standard deviations.
  Estimate(const Pose& at, double within_m, double within_rad);

  /// Predicts: the robot's odometry now reads `odometry`.
  void move(const Pose& odometry);
  /// Corrects: the robot sees at `seen`, in its own frame now, what stands at `known`. `within_m`
  /// is the deviation of both together. False: the gate rejected it as another object.
  bool see(Point seen, Point known, double within_m);

  const Pose& pose() const { return pose_; }
  double within_m() const;

 private:
  Pose pose_;
  Eigen::Matrix3d covariance_;
  Pose odometry_;
  bool begun_ = false;
};

}  // namespace verp::brain
