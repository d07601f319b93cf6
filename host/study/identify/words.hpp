#pragma once
#include <string>

#include "host/study/identify/identify.hpp"

namespace verp::identify {

/// For a terminal: each number before and after, and the residuals.
std::string text_of(const Result& result);

}  // namespace verp::identify
