#pragma once
#include <string>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/safety/machine.hpp"

namespace verp::session {

/// What becomes of a robot that falls or lies, as its controller tells it: counted, and in words
/// for whoever drives it, here or at the end of a link.
class FallStory {
 public:
  /// `tries`: how often in a row it is asked to get up; 0: nobody said.
  explicit FallStory(int tries = 0) : most_(tries) {}

  /// Of the tick just done. News in words; empty: none.
  std::string observe(const State& state, const Outputs& outputs);

  /// How often it came to lie, and got up.
  int falls() const { return falls_; }
  int get_ups() const { return get_ups_; }

 private:
  int most_, tries_ = 0;  ///< since it stood last
  int falls_ = 0, get_ups_ = 0;
  bool lies_ = false;  ///< and it was told how
  safety::Mode mode_ = safety::Mode::kRelaxed;
};

/// "on its back": how a body lies that sees the world's up there. It sees it as its controller
/// chooses an action by: the side that is down.
std::string how_it_lies(double up_x, double up_y);

}  // namespace verp::session
