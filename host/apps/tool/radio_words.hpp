#pragma once
#include <string>

#include "host/twin/radio/radio.hpp"

namespace verp::tool {

inline constexpr const char* kRadioWords =
    "numbers of the radio: 'range_m=5 loss=0.3' (also fade, fade_s, delay_s, jitter_s, bytes_s)";

/// NAME=VALUE pairs. Throws ToolError in the name of `command`.
radio::Conditions radio_of(const std::string& command, const std::string& text);

}  // namespace verp::tool
