#pragma once
#include <vector>

#include "host/apps/demos/run.hpp"

namespace verp::demos {

/// The track as a moving average, which removes the sway of the trunk.
std::vector<brain::Point> smooth(const Track& track);

/// A polyline, by distance along it.
class Line {
 public:
  explicit Line(std::vector<brain::Point> points);
  double long_m() const { return along_m_.empty() ? 0 : along_m_.back(); }
  /// Straight beyond both ends.
  brain::Pose at(double along_m) const;
  double off_m(brain::Point point) const;
  /// Distance along the line to point i.
  double along_m(std::size_t i) const { return along_m_.at(i); }

 private:
  std::vector<brain::Point> points_;
  std::vector<double> along_m_;
};

struct Spread {
  double rms = 0, worst = 0, least = 0;
};
Spread spread_of(const std::vector<double>& values);

/// Error of the robot's odometry at the end.
double drift_m(const Track& track);
double way_m(const Track& track);

}  // namespace verp::demos
