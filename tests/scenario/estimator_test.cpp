#include <algorithm>
#include <cmath>

#include "tests/scenario/walk.hpp"

namespace verp::scenario {
namespace {

// The promised accuracy of the estimate, at 0.25 m/s.
constexpr double kMostAttitude_deg = 0.5;
constexpr double kMostVelocity_m_s = 0.03;

struct Errors {
  double roll_deg = 0, pitch_deg = 0, worst_velocity_m_s = 0, odometry_share = 0;
};

// Most of the error is the accelerometer's offset: 5 mg one sigma, 0.3 degrees about each axis, of
// which a floor reveals a quarter. Another 0.15 degrees come and go with the steps.
Errors errors_of(int least_walks, const std::string& options) {
  const Walk seeds = walk("generic21 --velocity 0.25,0,0 --physics-step 2 " + options);
  Errors errors;
  double roll_deg2 = 0, pitch_deg2 = 0, walks = 0;
  for (const json& each : seeds.result.value("walks", json::array())) {
    if (!each.at("survived").get<bool>()) continue;  // another test judges falls
    const json& told = each.at("estimator");
    ++walks;
    roll_deg2 += std::pow(told.at("roll_rms_deg").get<double>(), 2);
    pitch_deg2 += std::pow(told.at("pitch_rms_deg").get<double>(), 2);
    errors.worst_velocity_m_s =
        std::max(errors.worst_velocity_m_s, told.at("com_velocity_rms_m_s").get<double>());
    errors.odometry_share =
        std::max(errors.odometry_share,
                 told.at("odometry_off_m").get<double>() / told.at("odometry_way_m").get<double>());
  }
  EXPECT_GE(walks, least_walks);
  errors.roll_deg = std::sqrt(roll_deg2 / walks);
  errors.pitch_deg = std::sqrt(pitch_deg2 / walks);
  return errors;
}

TEST(Estimator, KnowsTiltAndVelocityOfAWalk) {
  const Errors errors = errors_of(4, "--for 12 --seeds 1-5");
  expect_between(0.1, errors.roll_deg, kMostAttitude_deg, "roll, degrees rms");
  expect_between(0.1, errors.pitch_deg, kMostAttitude_deg, "pitch, degrees rms");
  expect_between(0.1, std::hypot(errors.roll_deg, errors.pitch_deg), kMostAttitude_deg,
                 "attitude as one angle, degrees rms");
  expect_between(0.005, errors.worst_velocity_m_s, kMostVelocity_m_s, "CoM velocity, m/s rms");
  expect_between(0.0, errors.odometry_share, 0.05, "odometry, part of the way");
}

TEST(Estimator, KnowsTiltAndVelocityOfRobotsDrawnAtRandom) {
  const Errors errors = errors_of(7, "--vary --for 12 --seeds 1-10");
  expect_between(0.1, errors.roll_deg, kMostAttitude_deg, "roll, degrees rms");
  expect_between(0.1, errors.pitch_deg, kMostAttitude_deg, "pitch, degrees rms");
  expect_between(0.005, errors.worst_velocity_m_s, kMostVelocity_m_s, "CoM velocity, m/s rms");
}

}  // namespace
}  // namespace verp::scenario
