#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace verp::cli {

/// The likeliest meaning of `word`: a name whose last part it is (lift_m: gait.lift_m), else a name
/// at most two letters away. Empty: none.
std::string nearest(std::string_view word, const std::vector<std::string>& names);

/// "; did you mean --step?", or at most five names that contain the word's last part, or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace verp::cli
