#pragma once
#include <utility>
#include <vector>

#include "host/apps/demos/brain/brain.hpp"

namespace verp::brain {

/// A piece of a way: so long, bent so much (1/m, to the left).
struct Bend {
  double long_m = 0, bent = 0;
};

/// A way of bends, one after the other.
class Route {
 public:
  Route(const Pose& from, std::vector<Bend> bends);
  double long_m() const { return long_m_; }
  /// The same way from elsewhere.
  Route from(const Pose& pose) const { return {pose, bends_}; }
  /// Beyond its ends it goes straight on.
  Pose at(double way_m) const;
  double bent(double way_m) const;

 private:
  Pose from_;
  std::vector<Bend> bends_;
  double long_m_ = 0;
};

/// Has `orders` walk so that the robot gets to `slot`, which itself moves along at v_m_s and turns
/// at w_rad_s; both of one frame. Sidesteps are small: they are the gait's weak side.
void steer(const Pose& robot, const Pose& slot, double v_m_s, double w_rad_s, Orders& orders);

/// Walks along a route, as far as the robot knows where it is.
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
