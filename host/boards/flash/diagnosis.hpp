#pragma once
#include <string>

#include "host/boards/flash/flash_error.hpp"
#include "host/boards/flash/plan.hpp"

namespace verp::flash {

/// Throws FlashError unless kCheckChip's output names the board's chip.
void check_chip(const Job& job, const std::string& output);

/// The error of a failed step; unknown output gives the tool's last line.
FlashError diagnose(const Job& job, const Step& step, const std::string& output);

/// udev rule for the devices of `tool`, and how to install it.
std::string udev_advice(Tool tool);

}  // namespace verp::flash
