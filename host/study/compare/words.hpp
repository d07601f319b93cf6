#pragma once
#include <numbers>
#include <string>

#include "host/study/compare/compare.hpp"

namespace verp::compare {

inline constexpr double kDegrees = 180 / std::numbers::pi;

std::string text_of(const Comparison& comparison);

/// A line per joint, units in the header. Missing values are empty cells.
std::string joints_csv(const Comparison& comparison);
/// A line per compared tick: the angles of both.
std::string angles_csv(const Comparison& comparison, const Pair& pair);

}  // namespace verp::compare
