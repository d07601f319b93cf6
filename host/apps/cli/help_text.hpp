#pragma once
#include <string>
#include <string_view>

/// Fits the --help pages to the width of the terminal.
namespace verp::cli {

/// COLUMNS if set, else the columns of the terminal on stdout; 100 without a terminal.
int help_width();

/// Wraps CLI11's descriptions in their column; below 60 columns, puts them below their word. A word
/// longer than the line stays whole.
std::string wrapped_help(std::string_view text, int width);

}  // namespace verp::cli
