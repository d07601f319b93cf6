#pragma once
#include <string>

#include "host/boards/flash/flash_error.hpp"
#include "host/boards/flash/plan.hpp"

/// Explains a flash tool's output to the user.
namespace verp::flash {

/// Throws FlashError if the output of a successful kCheckChip step names another chip than the
/// board's, or none.
void check_chip(const Job& job, const std::string& output);

/// Error for a failed step. Unknown output is reported by the tool's last line.
FlashError diagnose(const Job& job, const Step& step, const std::string& output);

/// The udev rule that lets this user open the devices of `tool`, and how to install it.
std::string udev_advice(Tool tool);

}  // namespace verp::flash
