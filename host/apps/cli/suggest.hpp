#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace verp::cli {

/// A name whose last part is `word` (lift_m: gait.lift_m), else one at most two letters away.
/// Empty: none.
std::string nearest(std::string_view word, const std::vector<std::string>& names);

/// "; did you mean --step?", at most five names that contain the word's last part, or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace verp::cli
