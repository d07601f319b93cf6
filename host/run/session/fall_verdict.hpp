#pragma once

namespace verp::session {

/// What is to be said of a robot that lies, when all that is known of its controller is which
/// servos have torque: whether it fell while somebody drove it, or lay down because it was let go.
/// A controller may see its fall coming and cut the torque: that is a fall as well.
class FallVerdict {
 public:
  /// Leaning further than this when torque goes off, a robot is falling: half of what the twin
  /// calls fallen (1 rad), and below what any controller may do (Tuning's fall_tilt_rad is 0.8);
  /// one that stands, sits or crouches leans less.
  static constexpr double kTipping_rad = 0.5;

  /// Once per tick. `torque`: any servo has it. `tilt_rad`: of the body's up from the world's.
  void see(bool torque, double tilt_rad, bool lies) {
    driven_ = driven_ || torque;
    if (torque) tipping_ = tilt_rad > kTipping_rad;
    if (!lies || fell_ || lay_down_) return;
    (torque || tipping_ ? fell_ : lay_down_) = true;
  }

  /// Somebody set it on its feet.
  void set_upright() { tipping_ = lay_down_ = false; }

  /// It got up by itself.
  void forget() { fell_ = lay_down_ = false; }

  /// Torque was on at some time.
  bool driven() const { return driven_; }
  bool fell() const { return fell_; }
  /// It lies, and was let go before it did. What is tried with it afterwards is no fall.
  bool lay_down() const { return lay_down_; }

 private:
  bool driven_ = false, tipping_ = false, fell_ = false, lay_down_ = false;
};

}  // namespace verp::session
