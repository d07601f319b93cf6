#pragma once
#include <string>

#include "host/study/identify/identify.hpp"

namespace verp::identify {

std::string text_of(const Result& result);

}  // namespace verp::identify
