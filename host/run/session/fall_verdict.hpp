#pragma once
#include <algorithm>

namespace verp::session {

/// How a robot came down since it was last upright. One that lies down on purpose crouches first,
/// by its goals: a weak robot sinks, too, but its joints do not follow.
class Descent {
 public:
  /// Share of the height that is lost as free fall (`verp check --json`): 1 to 3 % by generic21's,
  /// op3's and darwin_op's lie_down, at most 5 % in its test.
  static constexpr double kGently = 0.08;
  static constexpr double kUpright_rad = 0.2;
  static constexpr double kFollows_rad = 0.3;
  static constexpr double kCrouches = 0.85;  ///< of its height

  /// `off_rad`: the joint that is furthest from its goal.
  void see(double tilt_rad, double com_height_m, double com_up_m_s, double off_rad = 0) {
    highest_m_ = std::max(highest_m_, com_height_m);
    const bool upright = tilt_rad < kUpright_rad;
    if (upright) crouched_ = com_height_m < kCrouches * highest_m_ && off_rad < kFollows_rad;
    fastest_m_s_ = upright ? 0 : std::max(fastest_m_s_, -com_up_m_s);
  }
  double fastest_m_s() const { return fastest_m_s_; }
  /// Free fall that gives its fastest speed, as a share of its height.
  double fall_share(double gravity_m_s2) const {
    const double height_m = 2 * gravity_m_s2 * highest_m_;
    return height_m > 0 ? fastest_m_s_ * fastest_m_s_ / height_m : 0;
  }
  bool gentle(double gravity_m_s2) const {
    return crouched_ && fall_share(gravity_m_s2) <= kGently;
  }

 private:
  double highest_m_ = 0, fastest_m_s_ = 0;
  bool crouched_ = false;
};

/// Decides whether a lying robot fell, lay down, or was released. A controller that foresees its
/// fall and cuts the torque has fallen.
class FallVerdict {
 public:
  /// Half of the twin's limit (1 rad), below any controller's (fall_tilt_rad is 0.8), and more than
  /// a robot that stands, sits or crouches.
  static constexpr double kTipping_rad = 0.5;

  /// Call once per tick. `torque`: any servo has torque. `tilt_rad`: from the world's up. `gently`:
  /// it came down by a path, not in a fall.
  void see(bool torque, double tilt_rad, bool lies, bool gently = false) {
    driven_ = driven_ || torque;
    if (torque) tipping_ = tilt_rad > kTipping_rad;
    if (!lies || fell_ || lay_down_) return;
    ((torque ? !gently : tipping_) ? fell_ : lay_down_) = true;
  }

  void set_upright() { tipping_ = lay_down_ = false; }

  void forget() { fell_ = lay_down_ = false; }

  bool driven() const { return driven_; }
  bool fell() const { return fell_; }
  /// The robot was released before it lay, or lay down by itself: later attempts are not falls.
  bool lay_down() const { return lay_down_; }

 private:
  bool driven_ = false, tipping_ = false, fell_ = false, lay_down_ = false;
};

}  // namespace verp::session
