#pragma once
#include <fmt/format.h>

#include <optional>
#include <string>

#include "host/study/report/run_data.hpp"

/// A missing number is not shown as 0, which would look like a measurement.
namespace verp::report {

/// "0.173 m/s", or a dash; `unit` includes its space.
inline std::string or_dash(const std::optional<double>& value, int decimals, const char* unit) {
  return value ? fmt::format("{:.{}f}{}", *value, decimals, unit) : "-";
}

/// A walk's bias, or why there is no bias.
inline std::string bias_or_end(const SweepWalk& walk) {
  return walk.end == SweepWalk::End::kWalked ? or_dash(walk.bias_mm, 1, " mm") : name_of(walk.end);
}

inline std::string walked_step(const SweepWalk& walk) {
  return walk.step_m ? fmt::format("{:.1f} cm", 100 * *walk.step_m) : "-";
}

/// A note below a sweep's table with a `limited()` row.
inline constexpr const char* kLimitedNote =
    "walked: the longest step of the corrected walk, where gait.max_step_m, a leg's reach, the ZMP "
    "or the walk's length left less than was asked";

}  // namespace verp::report
