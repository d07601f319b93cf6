#pragma once
#include <numbers>
#include <string>

#include "host/study/compare/compare.hpp"

namespace verp::compare {

/// Of a radian: what people read.
inline constexpr double kDegrees = 180 / std::numbers::pi;

/// For a terminal: how the two lie together, a line for each joint, notes.
std::string text_of(const Comparison& comparison);

/// A line for each joint, with its units in the head. What there is none of is an empty cell.
std::string joints_csv(const Comparison& comparison);
/// A line for each tick that was compared: the angles of both.
std::string angles_csv(const Comparison& comparison, const Pair& pair);

}  // namespace verp::compare
