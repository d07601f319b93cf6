#pragma once
#include "common/safety/machine.hpp"

namespace verp::session {

inline constexpr int kGetUpTries = 3;

/// Limits attempts: a controller gets up on every order and would wear the robot out against an
/// obstacle.
class GetUp {
 public:
  enum class Phase {
    kUp,
    kFell,    ///< in this tick
    kDown,    ///< order it to get up, and nothing else
    kGaveUp,  ///< in this tick: no orders until it stood or fell again
  };

  /// `tries`: attempts in a row, 0: never; `down`: it may lie now.
  explicit GetUp(int tries, bool down = false) : most_(tries), down_(down && tries > 0) {}

  Phase observe(safety::Mode mode, double period_s);
  bool down() const { return down_; }

 private:
  int most_, tries_ = 0;  ///< since it last stood
  bool down_;             ///< it lies or fell, and must stand up
  double down_s_ = 0;     ///< time since then
  safety::Mode mode_ = safety::Mode::kRelaxed;
};

}  // namespace verp::session
