#include "host/run/session/fall_verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace verp::session {
namespace {

constexpr double kUpright = 0.1, kLying = 1.5;

TEST(FallVerdict, AFallWithTorqueIsOneAndStaysOne) {
  FallVerdict verdict;
  verdict.see(true, kUpright, false);
  verdict.see(true, kLying, true);
  EXPECT_TRUE(verdict.fell());
  verdict.see(false, kLying, true);
  EXPECT_TRUE(verdict.fell());
  EXPECT_FALSE(verdict.lay_down());
}

TEST(FallVerdict, AControllerThatLetsGoOfATippingRobotDoesNotMakeItGood) {
  FallVerdict verdict;
  verdict.see(true, 0.8, false);  // fall_tilt_rad: goes limp
  for (int i = 0; i < 20; ++i) verdict.see(false, 0.8 + 0.01 * i, false);
  verdict.see(false, 1.01, true, true);
  EXPECT_TRUE(verdict.fell());
}

TEST(FallVerdict, OneThatWasSetOnItsFeetMayLieDownAgainOrFall) {
  for (const bool torque : {false, true}) {
    FallVerdict verdict;
    verdict.see(true, kUpright, false);
    verdict.see(false, kLying, true);
    ASSERT_TRUE(verdict.lay_down());
    verdict.set_upright();
    verdict.see(torque, kUpright, false);
    EXPECT_FALSE(verdict.lay_down());
    verdict.see(torque, kLying, true);
    EXPECT_EQ(verdict.lay_down(), !torque);
    EXPECT_EQ(verdict.fell(), torque);
  }
}

TEST(FallVerdict, ARobotThatIsLetGoUprightLiesDown) {
  FallVerdict verdict;
  verdict.see(true, kUpright, false);
  for (const double tilt : {0.1, 0.4, 0.8}) verdict.see(false, tilt, false);
  verdict.see(false, kLying, true);
  EXPECT_TRUE(verdict.lay_down());
  EXPECT_FALSE(verdict.fell());
  verdict.see(true, kLying, true);  // ordered while it lies
  EXPECT_FALSE(verdict.fell());
}

struct Down {
  double crouch = 0.7, fastest_m_s = 0.4, off_rad = 0.1;
};

/// Stands 0.2 m high, crouches, then goes down with torque.
FallVerdict after(const Down& down) {
  const double height_m = 0.2, gravity_m_s2 = 9.8;
  FallVerdict verdict;
  Descent descent;
  descent.see(0, height_m, 0);
  for (double tilt = 0; tilt < 1.4; tilt += 0.1) {
    descent.see(tilt, height_m * down.crouch * std::cos(tilt), tilt > 0.5 ? -down.fastest_m_s : 0,
                down.off_rad);
    verdict.see(true, tilt, tilt > 1, descent.gentle(gravity_m_s2));
  }
  return verdict;
}

TEST(FallVerdict, ARobotThatLiesDownFromItsCrouchDoesNotFall) {
  EXPECT_TRUE(after({}).lay_down());
}

TEST(FallVerdict, ARobotThatComesDownFastOrFromTheStandOrBecauseItIsWeakFalls) {
  EXPECT_TRUE(after({.fastest_m_s = 0.8}).fell());
  EXPECT_TRUE(after({.crouch = 1}).fell());
  EXPECT_TRUE(after({.off_rad = 1}).fell());
}

TEST(FallVerdict, IsOneThingAndStaysThat) {
  std::minstd_rand random(3);
  std::uniform_real_distribution<double> tilt(0, 2);
  for (int run = 0; run < 500; ++run) {
    FallVerdict verdict;
    const bool ever = run % 4 != 0;
    bool fell = false, lay_down = false, lies = false;
    for (int i = 0; i < 50; ++i) {
      lies = lies || random() % 20 == 0;
      verdict.see(ever && random() % 2 == 0, tilt(random), lies);
      EXPECT_FALSE(verdict.fell() && verdict.lay_down());
      EXPECT_TRUE(verdict.fell() || !fell);
      EXPECT_TRUE(verdict.lay_down() || !lay_down);
      EXPECT_EQ(verdict.fell() || verdict.lay_down(), lies);
      fell = verdict.fell();
      lay_down = verdict.lay_down();
    }
    EXPECT_FALSE(!ever && (fell || verdict.driven()));
  }
}

}  // namespace
}  // namespace verp::session
