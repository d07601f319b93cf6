#include "host/twin/sim/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace verp::sim {
namespace {

constexpr double kLoopS = 0.001;

double way_s(Profile& profile, const ServoSetpoint& setpoint, double most_count_s,
             double most_count_s2) {
  profile.begin(setpoint, kLoopS);
  int loops = 0;
  for (double speed = profile.count_s(); profile.ongoing() && loops < 10'000; ++loops) {
    profile.advance(kLoopS);
    if (!profile.ongoing()) break;
    EXPECT_LE(std::abs(profile.count_s()), most_count_s * 1.001);
    EXPECT_LE(std::abs(profile.count_s() - speed), most_count_s2 * kLoopS * 1.001);
    speed = profile.count_s();
  }
  EXPECT_EQ(profile.count(), setpoint.goal_count);
  return loops * kLoopS;
}

// e-Manual, "What is the Profile": t3 = way / velocity + velocity / acceleration.
TEST(Profile, TakesTheTimesThatTheVendorGives) {
  Profile profile(0);
  ServoSetpoint setpoint{.goal_count = 1000};
  setpoint.profile_count_s = 500;
  setpoint.accelerate_count_s2 = 1000;
  EXPECT_NEAR(way_s(profile, setpoint, 500, 1000), 2.5, 0.02);
  EXPECT_EQ(profile.kind(), ProfileKind::kTrapezoidal);
  setpoint.goal_count = 900;  // below the speed: 2 sqrt(way / acceleration)
  EXPECT_NEAR(way_s(profile, setpoint, 500, 1000), 2 * std::sqrt(0.1), 0.02);
  EXPECT_EQ(profile.kind(), ProfileKind::kTriangular);
}

TEST(Profile, OfATimeTakesThatTime) {
  for (const double accelerate_ms : {0.0, 200.0, 900.0}) {
    Profile profile(0);
    ServoSetpoint setpoint{.goal_count = -1200, .profile_ms = 1000};
    setpoint.accelerate_ms = accelerate_ms;
    EXPECT_NEAR(way_s(profile, setpoint, 1e9, 1e9), 1.0, 0.02) << accelerate_ms;
  }
}

TEST(Profile, TurnsRoundWithoutAJump) {
  Profile profile(0);
  ServoSetpoint setpoint{.goal_count = 1000};
  setpoint.profile_count_s = 500;
  setpoint.accelerate_count_s2 = 1000;
  profile.begin(setpoint, kLoopS);
  for (int i = 0; i < 1000; ++i) profile.advance(kLoopS);
  EXPECT_NEAR(profile.count_s(), 500, 1);
  setpoint.goal_count = 0;
  const double from = profile.count();
  EXPECT_GT(way_s(profile, setpoint, 500, 1000), from / 500);
}

}  // namespace
}  // namespace verp::sim
