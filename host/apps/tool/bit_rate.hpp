#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/os/link/can_interface.hpp"

namespace verp::tool {

/// Throws ToolError for another bit rate than the robot's bus.
void check_bit_rate(const std::string& command, const link::CanInterface& interface,
                    const Params& params);

}  // namespace verp::tool
