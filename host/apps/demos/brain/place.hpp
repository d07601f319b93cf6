#pragma once
#include <Eigen/Core>

#include "host/apps/demos/brain/pose.hpp"

namespace verp::brain {

/// Where a robot is in a frame that it shares with others: its odometry, mended by seeing things of
/// which it knows where they are (an extended Kalman filter of three numbers).
class Estimate {
 public:
  /// It is put down there, and knows it so well.
  Estimate(const Pose& at, double within_m, double within_rad);

  /// Its odometry is that now.
  void move(const Pose& odometry);
  /// It sees at `seen`, in its own frame as it is now, what stands at `known`; the two together are
  /// known within `within_m`. False: that fits so badly that it is something else.
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
