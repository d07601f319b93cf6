#include "host/run/session/stride.hpp"

#include <gtest/gtest.h>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"

namespace verp::session {
namespace {

Command ahead(double step_m, double cycle_s) {
  Command command;
  command.vx_tenth_mm_s = static_cast<std::int16_t>(2e4 * step_m / cycle_s);
  return command;
}

Params robot(float cycle_s) {
  Params params = model::make_params(model::load_robot(model::find_model("generic21")));
  params.tuning.gait.max_step_m = 0.3F;
  params.tuning.gait.cycle_s = cycle_s;
  return params;
}

TEST(Stride, WhatTheServosFollowIsLeftAsItIs) {
  const Params params = robot(0.45F);
  const FeasibleVelocity followed = within_servo_speed(params, ahead(0.08, 0.45));
  EXPECT_EQ(followed.velocity.vx_tenth_mm_s, ahead(0.08, 0.45).vx_tenth_mm_s);
  EXPECT_EQ(followed.remark, "");
}

TEST(Stride, StepsThatTheServosCannotFollowAreShortenedWithARemark) {
  const Params params = robot(0.34F);
  const FeasibleVelocity followed = within_servo_speed(params, ahead(0.15, 0.34));
  EXPECT_GT(followed.velocity.vx_tenth_mm_s, ahead(0.05, 0.34).vx_tenth_mm_s);
  EXPECT_LT(followed.velocity.vx_tenth_mm_s, ahead(0.08, 0.34).vx_tenth_mm_s);
  EXPECT_NE(followed.remark.find("hip_pitch"), std::string::npos) << followed.remark;
  EXPECT_LE(fastest_joint(params, followed.velocity).share, kMostSpeedShare);
}

}  // namespace
}  // namespace verp::session
