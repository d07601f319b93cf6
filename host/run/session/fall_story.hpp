#pragma once
#include <string>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/safety/machine.hpp"

namespace verp::session {

/// Counts and describes falls and recoveries, by the controller's outputs.
class FallStory {
 public:
  /// `tries`: attempts in a row to get up; 0: unknown.
  explicit FallStory(int tries = 0) : most_(tries) {}

  /// Returns news as text, or empty.
  std::string observe(const State& state, const Outputs& outputs);

  int falls() const { return falls_; }
  int get_ups() const { return get_ups_; }

 private:
  int most_, tries_ = 0;  ///< since it last stood
  int falls_ = 0, get_ups_ = 0;
  bool lies_ = false;  ///< it lies, and the fall was reported
  safety::Mode mode_ = safety::Mode::kRelaxed;
};

/// "on its back" for a body that sees the world's up at (up_x, up_y), as the controller chooses its
/// action.
std::string how_it_lies(double up_x, double up_y);

}  // namespace verp::session
