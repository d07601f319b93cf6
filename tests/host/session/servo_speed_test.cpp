#include "host/run/session/servo_speed.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"

namespace verp::session {
namespace {

Params with_servos_of(float limit_rad_s) {
  Params params = model::make_params(model::load_robot(model::find_model("generic21")));
  for (int j = 0; j < params.joint_count; ++j) params.joint[j].velocity_limit_rad_s = limit_rad_s;
  return params;
}

TEST(ServoSpeed, OfFastServosIsEnoughForTheUsualWalk) {
  const ServoSpeed speed = servo_speed(with_servos_of(8));
  EXPECT_EQ(speed.most_m_s, speed.walk_m_s);
  EXPECT_EQ(speed.lower_lift_m, 0);
  EXPECT_EQ(text_of(speed).find("enough for 0.18 m/s: joint '"), 0U) << text_of(speed);
}

TEST(ServoSpeed, OfSlowerOnesIsEnoughForASlowerWalk) {
  const ServoSpeed speed = servo_speed(with_servos_of(3));
  EXPECT_GT(speed.most_m_s, 0.06);
  EXPECT_LT(speed.most_m_s, 0.17);
  EXPECT_GT(needed_rad_s(speed.fastest), 3 * kMostSpeedShare);
  EXPECT_NEAR(enough_rad_s(speed.fastest), needed_rad_s(speed.fastest) / kMostSpeedShare, 1e-9);
  EXPECT_NE(text_of(speed).find("and its servo turns 3;"), std::string::npos) << text_of(speed);
}

TEST(ServoSpeed, WhereALowerLiftLetsItWalkThatIsSaid) {
  Params params = with_servos_of(2.5F);
  const ServoSpeed speed = servo_speed(params);
  ASSERT_GT(speed.lower_lift_m, 0);
  EXPECT_LT(speed.lower_lift_m, params.tuning.gait.lift_m);
  params.tuning.gait.lift_m = static_cast<float>(speed.lower_lift_m);
  EXPECT_GT(servo_speed(params).most_m_s, speed.most_m_s);
}

TEST(ServoSpeed, WhereNoLiftHelpsBothSpeedsAndTheJointAreSaid) {
  const ServoSpeed speed = servo_speed(with_servos_of(1));
  EXPECT_EQ(speed.most_m_s, 0);
  EXPECT_EQ(speed.lower_lift_m, 0);
  EXPECT_EQ(
      text_of(speed),
      fmt::format("too low to walk: even on the spot joint '{}' needs up to {:.3g} rad/s, and "
                  "its servo turns 1; servos of {:.3g} rad/s would do",
                  speed.fastest.joint, needed_rad_s(speed.fastest), enough_rad_s(speed.fastest)));
}

}  // namespace
}  // namespace verp::session
