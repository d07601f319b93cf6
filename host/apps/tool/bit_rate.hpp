#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/os/link/can_interface.hpp"

namespace verp::tool {

/// Of every command that meets a robot on a CAN interface: throws ToolError if that runs at another
/// bit rate than the robot's bus, and tells what else its user should know.
void check_bit_rate(const std::string& command, const link::CanInterface& interface,
                    const Params& params);

}  // namespace verp::tool
