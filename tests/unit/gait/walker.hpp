#pragma once
#include "common/gait/gait.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::gait::test {

using namespace verp::test;

struct Walker {
  explicit Walker(const Params& robot, std::int32_t period_us = 10000) : params(&robot) {
    for (int j = 0; j < robot.joint_count; ++j) goal_rad[j] = robot.joint[j].stand_rad;
    in.goal_rad = goal_rad;
    in.period_us = period_us;
  }
  void tick() { out = update(*params, tuning, state, in); }
  void run(float duration_s) {
    for (std::int32_t us = 0; us < static_cast<std::int32_t>(duration_s * 1e6F);
         us += in.period_us) {
      tick();
    }
  }
  /// Waits for the body over the middle, then walks.
  void set_off(const VelocityIn& wanted) {
    in.walk = false;
    run(1.5F);
    in.walk = true;
    in.wanted = wanted;
  }
  Pose sole(int side) const { return sole_in_body(out.posture, side); }

  const Params* params;
  Tuning tuning;
  GaitState state;
  GaitIn in;
  GaitOut out;
  float goal_rad[kMaxJoints] = {};
};

inline float apart(Xy a, Xy b) {
  return math::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace verp::gait::test
