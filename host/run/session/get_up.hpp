#pragma once
#include "common/safety/machine.hpp"

namespace verp::session {

/// How often in a row a robot that lies is asked to get up, by whoever asks.
inline constexpr int kGetUpTries = 3;

/// Who has a robot get up counts the tries: the controller gets up whenever it is asked, and asked
/// for ever it would wear itself out on what keeps it down.
class GetUp {
 public:
  enum class Phase {
    kUp,
    kFell,    ///< just now, or once more
    kDown,    ///< it is to be asked to get up, and nothing else
    kGaveUp,  ///< just now: it lies, and is asked no more until it has stood or fell anew
  };

  /// `tries` in a row, 0: none, ever. `down`: it may lie now.
  explicit GetUp(int tries, bool down = false) : most_(tries), down_(down && tries > 0) {}

  /// Of the tick just done, of `period_s`.
  Phase observe(safety::Mode mode, double period_s);
  bool down() const { return down_; }

 private:
  int most_, tries_ = 0;  ///< since it stood last
  bool down_;             ///< it may lie, or fell, and is to stand up
  double down_s_ = 0;     ///< since then
  safety::Mode mode_ = safety::Mode::kRelaxed;
};

}  // namespace verp::session
