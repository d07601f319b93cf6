#pragma once
#include <string>
#include <string_view>

namespace verp::cli {

/// COLUMNS, else the terminal's columns; 100 without a terminal.
int help_width();

/// Wraps CLI11's descriptions in their column; below 60 columns, under their word. Long words stay
/// whole.
std::string wrapped_help(std::string_view text, int width);

}  // namespace verp::cli
