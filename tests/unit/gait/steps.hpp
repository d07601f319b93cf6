#pragma once
#include "common/gait/footsteps.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::gait::test {

using namespace verp::test;

inline constexpr int kSteps = 24;

struct Walk {
  GaitTuning tuning;
  FootstepState state;
  Step last = first_step(kRobot, tuning, state);

  const Step& take(const VelocityIn& wanted) {
    last = next_step(kRobot, tuning, wanted, last, state);
    return last;
  }
};

}  // namespace verp::gait::test
