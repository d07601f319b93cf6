#pragma once

namespace verp::session {

/// Decides whether a lying robot fell or was released. A controller that foresees its fall and cuts
/// the torque has fallen.
class FallVerdict {
 public:
  /// Half of the twin's limit (1 rad), below any controller's (fall_tilt_rad is 0.8), and more than
  /// a robot that stands, sits or crouches.
  static constexpr double kTipping_rad = 0.5;

  /// Call once per tick. `torque`: any servo has torque. `tilt_rad`: from the world's up.
  void see(bool torque, double tilt_rad, bool lies) {
    driven_ = driven_ || torque;
    if (torque) tipping_ = tilt_rad > kTipping_rad;
    if (!lies || fell_ || lay_down_) return;
    (torque || tipping_ ? fell_ : lay_down_) = true;
  }

  void set_upright() { tipping_ = lay_down_ = false; }

  void forget() { fell_ = lay_down_ = false; }

  bool driven() const { return driven_; }
  bool fell() const { return fell_; }
  /// The robot was released before it lay: later attempts are not falls.
  bool lay_down() const { return lay_down_; }

 private:
  bool driven_ = false, tipping_ = false, fell_ = false, lay_down_ = false;
};

}  // namespace verp::session
