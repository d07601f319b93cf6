#pragma once
#include <string>

#include "host/boards/flash/flash_error.hpp"
#include "host/boards/flash/plan.hpp"

/// What a flash tool's output means for the person at the desk.
namespace verp::flash {

/// Throws FlashError when the output of the kCheckChip step, which ended well, tells of another
/// chip than the board's, or of none.
void check_chip(const Job& job, const std::string& output);

/// Of a step that failed. Where nothing is known of its output, the tool's last line is told.
FlashError diagnose(const Job& job, const Step& step, const std::string& output);

/// The line that lets this user open what `tool` opens, and what to do with it.
std::string udev_advice(Tool tool);

}  // namespace verp::flash
