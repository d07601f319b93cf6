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
  verdict.see(false, 1.01, true);
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

TEST(FallVerdict, ARobotThatLiesDownGentlyWithTorqueDoesNotFall) {
  const double height_m = 0.2, gravity_m_s2 = 9.8;
  for (const double fastest_m_s : {0.4, 0.8}) {
    FallVerdict verdict;
    Descent descent;
    for (double tilt = 0; tilt < 1.4; tilt += 0.1) {
      descent.see(tilt, height_m * std::cos(tilt), tilt > 0.5 ? -fastest_m_s : 0);
      verdict.see(true, tilt, tilt > 1, descent.gentle(gravity_m_s2));
    }
    EXPECT_EQ(verdict.fell(), fastest_m_s > 0.5) << fastest_m_s;
    EXPECT_EQ(verdict.lay_down(), fastest_m_s < 0.5) << fastest_m_s;
  }
}

TEST(FallVerdict, ARobotThatSinksBecauseItIsWeakFalls) {
  FallVerdict verdict;
  Descent descent;
  for (double tilt = 0; tilt < 1.4; tilt += 0.1) {
    descent.see(tilt, 0.2 * std::cos(tilt), -0.1, tilt);
    verdict.see(true, tilt, tilt > 1, descent.gentle(9.8));
  }
  EXPECT_TRUE(verdict.fell());
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
