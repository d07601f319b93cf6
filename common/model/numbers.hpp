#pragma once
#include "common/model/params.hpp"

namespace verp {

/// Path of a number in Params, such as "joint[3].lower_rad" or "tuning.gait.cycle_s".
inline constexpr int kFieldNameLength = 40;
struct FieldName {
  char text[kFieldNameLength] = {};
};

/// True if every number of a well-formed Params is finite and inside the generous bounds of
/// numbers.cpp; outside them goals and thresholds are meaningless. Otherwise `bad` names the first
/// number that is not.
bool numbers_fit(const Params& params, FieldName& bad);

}  // namespace verp
