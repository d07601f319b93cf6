#include "host/run/session/asked.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace verp::session {
namespace {

Command velocity(double vx_m_s, double vy_m_s, double wz_rad_s) {
  Command command;
  command.vx_tenth_mm_s = static_cast<std::int16_t>(1e4 * vx_m_s);
  command.vy_tenth_mm_s = static_cast<std::int16_t>(1e4 * vy_m_s);
  command.wz_mrad_s = static_cast<std::int16_t>(1e3 * wz_rad_s);
  return command;
}

sim::WalkMetrics walked(double distance_m, double ahead_m, double left_m, double turned_deg) {
  sim::WalkMetrics metrics;
  metrics.walk_s = 20;
  metrics.distance_m = distance_m;
  metrics.ahead_m = ahead_m;
  metrics.lateral_drift_m = left_m;
  metrics.yaw_drift_deg = turned_deg;
  return metrics;
}

TEST(AskedWay, OfAQuarterCircleEndsAsideAsFarAsAhead) {
  const double wz_rad_s = std::numbers::pi / 2 / 10;
  const Way way = asked_way(velocity(0.1, 0, wz_rad_s), 10);
  const double radius_m = 0.1 / wz_rad_s;
  EXPECT_NEAR(way.length_m, 1, 1e-9);
  EXPECT_NEAR(way.turn_rad, std::numbers::pi / 2, 0.01);
  EXPECT_NEAR(way.point_m.back().x(), radius_m, 0.01);
  EXPECT_NEAR(way.point_m.back().y(), radius_m, 0.01);
  for (const sim::Vec2& point : way.point_m) {
    EXPECT_NEAR((point - sim::Vec2(0, radius_m)).norm(), radius_m, 0.01);
  }
}

TEST(AskedWay, StraightIsALine) {
  const Way way = asked_way(velocity(-0.1, 0.05, 0), 10);
  EXPECT_NEAR((way.point_m.back() - sim::Vec2(-1, 0.5)).norm(), 0, 1e-9);
  EXPECT_EQ(way.turn_rad, 0);
}

// A robot that shuffled on the spot once "walked without a fall".
TEST(Shortfall, OneCentimetreIsNoWalk) {
  EXPECT_NE(shortfall(velocity(0.18, 0, 0), walked(0.01, 0.01, 0, 0)), "");
  EXPECT_NE(shortfall(velocity(0.18, 0, 0), walked(1.5, 1.5, 0, 0)), "");
  EXPECT_EQ(shortfall(velocity(0.18, 0, 0), walked(3.3, 3.3, 0.1, 2)), "");
}

TEST(Shortfall, TheOtherWayIsNoWalk) {
  EXPECT_NE(shortfall(velocity(-0.1, 0, 0), walked(1.9, 1.9, 0, 0)), "");
  EXPECT_NE(shortfall(velocity(0, 0.05, 0), walked(0.9, 0, -0.9, 0)), "");
}

TEST(Shortfall, ATurnIsAskedToo) {
  EXPECT_NE(shortfall(velocity(0, 0, 0.3), walked(0.1, 0, 0, 20)), "");
  EXPECT_NE(shortfall(velocity(0, 0, 0.3), walked(0.1, 0, 0, -320)), "");
  EXPECT_EQ(shortfall(velocity(0, 0, -0.3), walked(0.1, 0, 0, -260)), "");
  EXPECT_EQ(shortfall(velocity(0.1, 0, 0.2), walked(1.9, 0.1, 0.1, 210)), "");
}

// Eight steps of one second; the first and last four are short.
TEST(Shortfall, SlowGaitsStartAndStopSlowly) {
  GaitTuning slow;
  slow.cycle_s = 2;
  sim::WalkMetrics eight = walked(0.10, 0.10, 0, 0);
  eight.walk_s = 8;
  EXPECT_EQ(shortfall(velocity(0.04, 0, 0), eight, slow), "");
  eight.distance_m = eight.ahead_m = 0.02;
  EXPECT_NE(shortfall(velocity(0.04, 0, 0), eight, slow), "");
}

// generic21's strides of 1, 2, 3, 4, 3, 2, 1 cm and one that closes the feet fill 2.58 s.
TEST(Shortfall, AShortWalkIsHeldByWhatItsGaitGoesInThatTime) {
  const Command fast = velocity(0.6, 0, 0);
  EXPECT_NEAR(within_reach(fast, 2.58, {}).length_m, 0.16, 1e-6);
  sim::WalkMetrics as_planned = walked(0.17, 0.17, 0, 0);
  as_planned.walk_s = 2.58;
  EXPECT_EQ(shortfall(fast, as_planned), "");
  EXPECT_NE(slow_start(fast, as_planned).find("0.17 m of the 1.55 m asked"), std::string::npos);
  sim::WalkMetrics stuck = walked(0.03, 0.03, 0, 0);
  stuck.walk_s = 2.58;
  EXPECT_NE(shortfall(fast, stuck), "");
}

TEST(Shortfall, OfAShortTurnToo) {
  const Command turn = velocity(0, 0, 1.5);
  const double within_deg = within_reach(turn, 2.58, {}).turn_rad * 180 / std::numbers::pi;
  EXPECT_GT(within_deg, 60);
  sim::WalkMetrics little = walked(0, 0, 0, 0.3 * within_deg);
  little.walk_s = 2.58;
  EXPECT_NE(shortfall(turn, little), "");
  little.yaw_drift_deg = 0.9 * within_deg;
  EXPECT_EQ(shortfall(turn, little), "");
}

TEST(Shortfall, OfALongWalkTheStartIsLittle) {
  const Command slow = velocity(0.18, 0, 0);
  EXPECT_NEAR(within_reach(slow, 60, {}).length_m, asked_way(slow, 60).length_m, 0.4);
  EXPECT_EQ(slow_start(slow, walked(3.3, 3.3, 0.1, 2)), "");
}

TEST(Shortfall, SteppingInPlaceIsWhatWasAsked) {
  EXPECT_EQ(shortfall(velocity(0, 0, 0), walked(0.02, -0.01, 0, 3)), "");
}

}  // namespace
}  // namespace verp::session
