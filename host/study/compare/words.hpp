#pragma once
#include <numbers>
#include <string>

#include "host/study/compare/compare.hpp"

namespace verp::compare {

inline constexpr double kDegrees = 180 / std::numbers::pi;

std::string text_of(const Comparison& comparison);

/// One line per joint, with units in the header and empty cells for missing values.
std::string joints_csv(const Comparison& comparison);
/// One line per compared tick.
std::string angles_csv(const Comparison& comparison, const Pair& pair);

}  // namespace verp::compare
