#pragma once
#include <fmt/format.h>

#include <optional>
#include <string>

#include "host/study/report/run_data.hpp"

/// Numbers that may be missing, in words: a zero would be taken for a measurement.
namespace verp::report {

/// "0.173 m/s", or a dash. `unit` comes with its space.
inline std::string or_dash(const std::optional<double>& value, int decimals, const char* unit) {
  return value ? fmt::format("{:.{}f}{}", *value, decimals, unit) : "-";
}

/// A sweep's bias, or why there is none.
inline std::string bias_or_end(const SweepWalk& walk) {
  return walk.end == SweepWalk::End::kWalked ? or_dash(walk.bias_mm, 1, " mm") : name_of(walk.end);
}

inline std::string walked_step(const SweepWalk& walk) {
  return walk.step_m ? fmt::format("{:.1f} cm", 100 * *walk.step_m) : "-";
}

/// Stands below a sweep's table when some row `limited()`.
inline constexpr const char* kLimitedNote =
    "walked: the longest step of the corrected walk, where gait.max_step_m, a leg's reach, the ZMP "
    "or the walk's length left less than was asked";

}  // namespace verp::report
