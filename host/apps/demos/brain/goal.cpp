#include "host/apps/demos/brain/goal.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/apps/demos/brain/grid.hpp"

namespace verp::brain {
namespace {

constexpr double kSpeed_m_s = 0.14;
constexpr double kPlan_s = 0.5;
constexpr double kThere_m = 0.1;
constexpr double kLook_m = 0.3;  // ahead on the path

class GoalGoer final : public Brain {
 public:
  GoalGoer(const About& about, Point goal) : about_(about), goal_(goal) {}

  Orders think(const Senses& senses) override {
    Orders orders;
    if (!senses.ready) return orders;
    if (!begun_) begin(senses);
    if (senses.scan) look(*senses.scan);
    const Pose here = out_of(odometry_frame_, senses.odometry);
    if (distance(here.at_m, goal_) < kThere_m) there_ = true;
    orders.done = there_;
    if (there_ || grid_.empty()) return orders;
    if (senses.now_s >= next_s_) {
      next_s_ = senses.now_s + kPlan_s;
      way_ = way(grid_, here.at_m, goal_);
    }
    walk(here, orders);
    return orders;
  }

 private:
  /// The robot's present pose becomes the map's origin.
  void begin(const Senses& senses) {
    begun_ = true;
    odometry_frame_ = into(senses.odometry, Pose{});
  }

  void look(const Scan& scan) {
    std::vector<Hit> seen = hits(about_, scan);
    nearest_ahead_m_ = about_.laser_max_m;
    for (const Hit& hit : seen) {
      constexpr double kHalf_rad = 0.5;
      if (std::abs(direction_rad(hit.at_m)) < kHalf_rad)
        nearest_ahead_m_ = std::min(nearest_ahead_m_, length(hit.at_m));
    }
    Pose there = out_of(odometry_frame_, scan.odometry);
    if (!grid_.empty()) {
      there = matched(grid_, there, seen);
      // From now on, odometry in this frame gives the pose in the map.
      odometry_frame_ = out_of(there, into(scan.odometry, Pose{}));
    }
    grid_.add(there, about_, seen);
  }

  void walk(const Pose& here, Orders& orders) {
    constexpr double kTurn_1_s = 1.3, kMostTurn_rad_s = 0.45, kOnTheSpot_rad = 0.7;
    constexpr double kStop_m = 0.24;
    orders.walk = true;
    if (way_.empty()) {  // looks around
      orders.wz_rad_s = 0.3;
      return;
    }
    const double off_rad = direction_rad(into(here, ahead(here.at_m)));
    orders.wz_rad_s = within(kTurn_1_s * off_rad, kMostTurn_rad_s);
    const double share = std::max(0.0, std::cos(off_rad));
    const double slow = std::min(1.0, distance(here.at_m, goal_) / 0.25);
    if (std::abs(off_rad) < kOnTheSpot_rad && nearest_ahead_m_ > kStop_m)
      orders.vx_m_s = kSpeed_m_s * share * share * std::max(0.4, slow);
  }

  /// The point of the path a little beyond the nearest one.
  Point ahead(Point here) const {
    std::size_t i = 0;
    for (std::size_t k = 1; k < way_.size(); ++k) {
      if (distance(way_[k], here) < distance(way_[i], here)) i = k;
    }
    while (i + 1 < way_.size() && distance(way_[i], here) < kLook_m) ++i;
    return way_[i];
  }

  const About about_;
  const Point goal_;
  Grid grid_;
  Pose odometry_frame_;  ///< in the map frame
  std::vector<Point> way_;
  double next_s_ = 0, nearest_ahead_m_ = 0;
  bool begun_ = false, there_ = false;
};

}  // namespace

std::unique_ptr<Brain> make_goal_goer(const About& about, Point goal) {
  return std::make_unique<GoalGoer>(about, goal);
}

}  // namespace verp::brain
