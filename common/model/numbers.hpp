#pragma once
#include "common/model/params.hpp"

namespace verp {

/// A number of Params as a person would write it: "joint[3].lower_rad", "tuning.gait.cycle_s".
inline constexpr int kFieldNameLength = 40;
struct FieldName {
  char text[kFieldNameLength] = {};
};

/// True when every number of a well-formed Params is one that a robot can have: finite, and inside
/// generous bounds (numbers.cpp) outside of which goals or thresholds would mean nothing. Else the
/// first that is not is named in `bad`.
bool numbers_fit(const Params& params, FieldName& bad);

}  // namespace verp
