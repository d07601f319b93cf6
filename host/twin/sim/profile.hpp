#pragma once
#include <cstdint>

#include "host/twin/sim/plant.hpp"

namespace verp::sim {

/// Trajectory to the goal, in counts (e-Manual, "What is the Profile" and Profile Velocity (112)).
/// Jerk is not limited here.
class Profile {
 public:
  explicit Profile(double count) : goal_count_(count), count_(count) {}

  /// Sets position and speed and ends the profile.
  void stand(double count, double speed_count_s = 0);
  /// step_s: the loop's period, the duration of a step profile.
  void begin(const ServoSetpoint& setpoint, double step_s);
  void advance(double step_s);
  /// Velocity mode: accelerates to that speed with at most `accelerate_count_s2`; 0: at once.
  void follow_speed(double goal_count_s, double accelerate_count_s2, double step_s);

  double goal_count() const { return goal_count_; }
  double count() const { return count_; }
  double count_s() const { return speed_count_s_; }
  bool ongoing() const { return ongoing_; }
  ProfileKind kind() const { return kind_; }

 private:
  bool straight() const {
    return kind_ == ProfileKind::kStep || kind_ == ProfileKind::kRectangular;
  }
  void advance_straight(double step_s);
  void advance_curved(double step_s);

  double goal_count_;
  double count_;
  double line_count_s_ = 0;  ///< of a straight profile
  double speed_count_s_ = 0;
  double top_count_s_ = 0;
  double accelerate_count_s2_ = 0;
  ProfileKind kind_ = ProfileKind::kStep;
  bool ongoing_ = false;
};

}  // namespace verp::sim
