#pragma once
#include <deque>
#include <utility>

namespace verp::view {

/// How fast simulated time goes by beside the wall's. Knows no clock: is told the times.
class Pace {
 public:
  /// 1: as the wall's; 0: as fast as it can.
  void set_speed(double factor, double simulated_s, double wall_s);
  double speed() const { return speed_; }
  /// From here on, as after a pause: what went by before is not caught up.
  void begin(double simulated_s, double wall_s);

  /// How long to wait with a tick that begins at that simulated time. One that is late by more than
  /// kMostLate_s is not caught up either: a busy PC makes a run slow, never hasty.
  double wait_s(double simulated_s, double wall_s);

  /// How late the last tick was that was waited for; its delay counts though it is not caught up.
  double late_s() const { return late_s_; }

  /// Real-time factor over the last second.
  double factor() const;
  void ticked(double simulated_s, double wall_s);

  static constexpr double kMostLate_s = 0.2;

 private:
  double speed_ = 1;
  double simulated_s_ = 0, wall_s_ = 0;  ///< where it began
  double late_s_ = 0;
  std::deque<std::pair<double, double>> last_;
};

/// Until the window's next picture. Drawing and the twin share the PC's cores, and the twin comes
/// first: beside one that is late there are fewer pictures.
int frame_ms(double late_s);

}  // namespace verp::view
