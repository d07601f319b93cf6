#pragma once
#include "common/model/params.hpp"

namespace verp {

/// Such as "joint[3].lower_rad" or "tuning.gait.cycle_s".
inline constexpr int kFieldNameLength = 40;
struct FieldName {
  char text[kFieldNameLength] = {};
};

/// True if every number of a well-formed Params is finite and inside the bounds of numbers.cpp.
/// Else `bad` names the first that is not.
bool numbers_fit(const Params& params, FieldName& bad);

}  // namespace verp
