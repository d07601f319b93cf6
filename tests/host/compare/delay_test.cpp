#include "host/study/compare/delay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace verp::compare {
namespace {

constexpr double kStep_s = 0.01;

double signal(double t_s) {
  return 0.3 * std::sin(2 * std::numbers::pi * 2.2 * t_s) +
         0.1 * std::cos(2 * std::numbers::pi * 4.4 * t_s);
}

std::vector<double> sampled(double delay_s, double offset, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  std::vector<double> values;
  for (int i = 0; i < 400; ++i) {
    values.push_back(signal(i * kStep_s - delay_s) + offset + noise * normal(random));
  }
  return values;
}

TEST(Delay, IsFoundBetweenSteps) {
  for (const double delay_s : {-0.0173, -0.005, 0.0, 0.0025, 0.01, 0.0377}) {
    const auto found = delay_of(shifts_of(sampled(0, 0, 0, 1), sampled(delay_s, 0.03, 0, 2), 20));
    ASSERT_TRUE(found) << delay_s;
    EXPECT_NEAR(found->steps * kStep_s, delay_s, 2e-5) << delay_s;
    EXPECT_NEAR(found->offset, 0.03, 1e-3) << delay_s;
    EXPECT_LT(found->left_rms, 5e-3) << delay_s;
  }
}

TEST(Delay, NoiseIsLeftAndMovesItLittle) {
  const auto found = delay_of(shifts_of(sampled(0, 0, 0.01, 1), sampled(0.0125, 0, 0.01, 2), 20));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->steps * kStep_s, 0.0125, 5e-4);
  EXPECT_NEAR(found->left_rms, 0.01 * std::numbers::sqrt2, 2e-3);
}

TEST(Delay, BeyondTheRangeOrOfNothingThereIsNone) {
  EXPECT_FALSE(delay_of(shifts_of(sampled(0, 0, 0, 1), sampled(0.1, 0, 0, 2), 8)));
  const std::vector<double> still(400, 0.5);
  EXPECT_FALSE(delay_of(shifts_of(still, still, 8)));
  EXPECT_FALSE(delay_of(shifts_of(std::vector<double>(10, 1.0), still, 8)));
}

TEST(Wave, OfPartOfAPeriodHasItsAmplitudeAndPhase) {
  std::vector<double> a, b;
  for (int i = 0; i < 133; ++i) {
    const double w = 2 * std::numbers::pi * 2.2 * i * kStep_s;
    a.push_back(7 + 0.3 * std::cos(w));
    b.push_back(-2 + 0.15 * std::cos(w - 0.4));
  }
  const Wave of_a = wave_of(a, kStep_s, 2.2), of_b = wave_of(b, kStep_s, 2.2);
  EXPECT_NEAR(of_a.amplitude(), 0.3, 1e-9);
  EXPECT_NEAR(of_b.amplitude(), 0.15, 1e-9);
  EXPECT_NEAR(phase_lag_rad(of_a, of_b), 0.4, 1e-9);
  EXPECT_NEAR(phase_lag_rad(of_b, of_a), -0.4, 1e-9);
}

}  // namespace
}  // namespace verp::compare
