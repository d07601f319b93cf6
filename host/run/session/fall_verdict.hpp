#pragma once

namespace verp::session {

/// Decides whether a robot that lies fell while driven, or lay down because it was released. The
/// only knowledge of the controller is which servos have torque. A controller may foresee its fall
/// and cut the torque: that is a fall as well.
class FallVerdict {
 public:
  /// A robot that leans further when torque goes off is falling. Half of the twin's limit for
  /// fallen (1 rad), and below any controller's limit (Tuning's fall_tilt_rad is 0.8); a robot that
  /// stands, sits or crouches leans less.
  static constexpr double kTipping_rad = 0.5;

  /// Once per tick. `torque`: any servo has torque. `tilt_rad`: between the body's up and the
  /// world's.
  void see(bool torque, double tilt_rad, bool lies) {
    driven_ = driven_ || torque;
    if (torque) tipping_ = tilt_rad > kTipping_rad;
    if (!lies || fell_ || lay_down_) return;
    (torque || tipping_ ? fell_ : lay_down_) = true;
  }

  /// The user set it on its feet.
  void set_upright() { tipping_ = lay_down_ = false; }

  /// It got up by itself.
  void forget() { fell_ = lay_down_ = false; }

  /// Torque has been on.
  bool driven() const { return driven_; }
  bool fell() const { return fell_; }
  /// The robot was released before it lay. Later attempts with it are not falls.
  bool lay_down() const { return lay_down_; }

 private:
  bool driven_ = false, tipping_ = false, fell_ = false, lay_down_ = false;
};

}  // namespace verp::session
