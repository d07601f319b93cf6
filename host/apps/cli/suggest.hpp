#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace verp::cli {

/// The one of `names` that `word` was most likely meant to be: the one it is the last part of
/// (lift_m: gait.lift_m), else one at most two letters away. Empty when there is none.
std::string nearest(std::string_view word, const std::vector<std::string>& names);

/// "; did you mean --step?", or of at most five names that hold the word's last part, or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace verp::cli
