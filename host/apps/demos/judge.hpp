#pragma once
#include <vector>

#include "host/apps/demos/run.hpp"

namespace verp::demos {

/// A walker's trunk sways: where it was without that, at each moment.
std::vector<brain::Point> smooth(const Track& track);

/// A line through points, by how far along it is.
class Line {
 public:
  explicit Line(std::vector<brain::Point> points);
  double long_m() const { return along_m_.empty() ? 0 : along_m_.back(); }
  /// Beyond its ends it goes straight on.
  brain::Pose at(double along_m) const;
  double off_m(brain::Point point) const;
  /// How far along its point number i is.
  double along_m(std::size_t i) const { return along_m_.at(i); }

 private:
  std::vector<brain::Point> points_;
  std::vector<double> along_m_;
};

/// Of many values.
struct Spread {
  double rms = 0, worst = 0, least = 0;
};
Spread spread_of(const std::vector<double>& values);

/// How far a robot's odometry was off at the end.
double drift_m(const Track& track);
double way_m(const Track& track);

}  // namespace verp::demos
