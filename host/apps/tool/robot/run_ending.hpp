#pragma once
#include <string>

#include "common/control/state.hpp"
#include "common/io/io.hpp"

namespace verp::tool {

/// How a robot ends that let go, by its own IMU.
class RunEnding {
 public:
  /// Call every tick.
  void observe(const State& state, const Outputs& outputs, double period_s);

  /// Time since torque went off; 0: it is on.
  double limp_s() const { return limp_s_; }
  /// "lies on its front", "leans by 40 degrees", "is upright", or "not known: the IMU is silent".
  std::string words() const;
  /// It was upright when torque went off, and lies now. A silent IMU does not say so.
  bool fell() const { return was_upright_ && lies_ && !blind_; }
  /// Time from torque off to lying.
  double fell_s() const { return fell_s_; }

 private:
  double limp_s_ = 0, fell_s_ = 0;
  bool was_upright_ = true, lies_ = false, blind_ = false;
  Xyz up_ = {0, 0, 1};
};

}  // namespace verp::tool
