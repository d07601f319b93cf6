#pragma once
#include <string>

/// Values outside are typing or unit errors. The controller's float32 resolves 1 um in 10 m; in
/// sums of mass times length squared, larger parts would drown the others' digits.
namespace verp::model {

constexpr double kMostMass_kg = 1000;
constexpr double kLeastMass_kg = 1e-6;
constexpr double kMostLength_m = 10;
constexpr double kLeastLength_m = 1e-4;
constexpr double kMostAngle = 1000;  ///< for degrees and whole turns
/// For kLeastMass_kg or more: a 1 mg ball of tungsten has 0.15 mm.
constexpr double kLeastGyration_m = 1e-4;
constexpr double kLeastSpeed_rad_s = 0.01;  ///< a joint that is meant to move
constexpr double kMostFriction = 100;
constexpr double kMostStiffness_n_m = 1e12;  ///< SDF's default
constexpr double kMostDamping_n_s_m = 1e9;
constexpr int kShortestPeriod_us = 4000;
constexpr int kLongestPeriod_us = 20000;

/// Throws LoadError at the line, with the bounds.
void require_within(const std::string& file, int line, const std::string& what, double value,
                    double low, double high, const char* unit);

}  // namespace verp::model
