#pragma once
#include <string>

#include "host/study/identify/identify.hpp"

namespace verp::identify {

/// For a terminal: each number as it was and is, what is left.
std::string text_of(const Result& result);

}  // namespace verp::identify
