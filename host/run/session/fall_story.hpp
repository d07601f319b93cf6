#pragma once
#include <string>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/safety/machine.hpp"

namespace verp::session {

/// Counts and describes a robot's falls and recoveries, from its controller's outputs.
class FallStory {
 public:
  /// `tries`: attempts in a row to get up; 0: unknown.
  explicit FallStory(int tries = 0) : most_(tries) {}

  /// Observes the last tick. Returns news as text; empty: none.
  std::string observe(const State& state, const Outputs& outputs);

  /// Number of falls, and of recoveries.
  int falls() const { return falls_; }
  int get_ups() const { return get_ups_; }

 private:
  int most_, tries_ = 0;  ///< since it last stood
  int falls_ = 0, get_ups_ = 0;
  bool lies_ = false;  ///< and the fall was reported
  safety::Mode mode_ = safety::Mode::kRelaxed;
};

/// "on its back": the side that is down, for a body that sees the world's up at (up_x, up_y). The
/// controller chooses its action by the same rule.
std::string how_it_lies(double up_x, double up_y);

}  // namespace verp::session
