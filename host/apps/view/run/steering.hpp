#pragma once
#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp::view {

/// Each press adds a quarter of the robot's limit, until stop().
class Steering {
 public:
  explicit Steering(const Params& params);

  /// Quarters ahead, to the left, and of a turn to the left.
  void nudge(int ahead, int left, int turn);
  /// Sticks, -1 to 1; all 0: stand.
  void lean(double ahead, double left, double turn);
  void stop();
  void relax();
  const Command& command() const { return command_; }

 private:
  void ask();

  double ahead_m_s_, left_m_s_, turn_rad_s_;  ///< quarter of the limit
  double ahead_ = 0, left_ = 0, turn_ = 0;    ///< quarters
  Command command_;
};

}  // namespace verp::view
