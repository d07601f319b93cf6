#pragma once
#include <utility>
#include <vector>

#include "host/apps/demos/brain/brain.hpp"

namespace verp::brain {

/// A piece of a route: its length and its curvature (1/m, positive left).
struct Bend {
  double long_m = 0, bent = 0;
};

class Route {
 public:
  Route(const Pose& from, std::vector<Bend> bends);
  double long_m() const { return long_m_; }
  /// The same route from another start.
  Route from(const Pose& pose) const { return {pose, bends_}; }
  /// Straight beyond both ends.
  Pose at(double way_m) const;
  double bent(double way_m) const;

 private:
  Pose from_;
  std::vector<Bend> bends_;
  double long_m_ = 0;
};

/// Sets `orders` so that the robot reaches `slot`, which moves at v_m_s and turns at w_rad_s; both
/// poses in one frame. Sidesteps stay small: the gait does them badly.
void steer(const Pose& robot, const Pose& slot, double v_m_s, double w_rad_s, Orders& orders);

/// Walks along a route by the robot's own pose estimate.
class Walker {
 public:
  Walker(Route route, double speed_m_s) : route_(std::move(route)), speed_m_s_(speed_m_s) {}
  void walk(const Pose& robot, Orders& orders);
  double way_m() const { return way_m_; }
  double speed_m_s() const { return over() ? 0 : speed_m_s_; }
  bool over() const { return way_m_ >= route_.long_m(); }
  const Route& route() const { return route_; }

 private:
  Route route_;
  double speed_m_s_, way_m_ = 0;
};

}  // namespace verp::brain
