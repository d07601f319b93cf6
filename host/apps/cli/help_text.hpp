#pragma once
#include <string>
#include <string_view>

/// The pages of --help, as wide as the terminal they are read on.
namespace verp::cli {

/// Columns of the terminal on stdout; of COLUMNS, if that is set; 100 elsewhere.
int help_width();

/// CLI11's two columns with each description broken at spaces and kept in its column; below 60
/// columns it stands below its word. A word longer than the line stays whole.
std::string wrapped_help(std::string_view text, int width);

}  // namespace verp::cli
