#pragma once
#include <deque>
#include <utility>

namespace verp::view {

/// Paces simulated time by wall time. The caller passes both: Pace reads no clock.
class Pace {
 public:
  /// 1: real time; 0: unpaced.
  void set_speed(double factor, double simulated_s, double wall_s);
  double speed() const { return speed_; }
  /// Restarts here: earlier delay is not made up.
  void begin(double simulated_s, double wall_s);

  /// Wait before a tick. A delay above kMostLate_s is not made up: a busy PC never makes a run
  /// hurry.
  double wait_s(double simulated_s, double wall_s);

  /// Delay of the last paced tick, even if it is not made up.
  double late_s() const { return late_s_; }

  double factor() const;
  void ticked(double simulated_s, double wall_s);

  static constexpr double kMostLate_s = 0.2;

 private:
  double speed_ = 1;
  double simulated_s_ = 0, wall_s_ = 0;  ///< the start
  double late_s_ = 0;
  std::deque<std::pair<double, double>> last_;
};

/// Time to the next picture. The twin comes first: a late run gets fewer pictures.
int frame_ms(double late_s);

}  // namespace verp::view
