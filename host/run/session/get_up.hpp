#pragma once
#include "common/safety/machine.hpp"

namespace verp::session {

/// Usual number of attempts in a row to get up.
inline constexpr int kGetUpTries = 3;

/// Limits attempts to get up. The controller gets up whenever it is ordered to, and without a limit
/// it would wear the robot out against an obstacle.
class GetUp {
 public:
  enum class Phase {
    kUp,
    kFell,    ///< in this tick, perhaps again
    kDown,    ///< order it to get up, and nothing else
    kGaveUp,  ///< in this tick: no more orders until it has stood or fallen again
  };

  /// `tries` in a row; 0: never. `down`: it may lie now.
  explicit GetUp(int tries, bool down = false) : most_(tries), down_(down && tries > 0) {}

  /// Observes the last tick, of `period_s`.
  Phase observe(safety::Mode mode, double period_s);
  bool down() const { return down_; }

 private:
  int most_, tries_ = 0;  ///< since it last stood
  bool down_;             ///< it may lie, or fell, and must stand up
  double down_s_ = 0;     ///< time since then
  safety::Mode mode_ = safety::Mode::kRelaxed;
};

}  // namespace verp::session
