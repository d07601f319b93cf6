#pragma once
#include <string>

namespace verp::tool {

/// Writes a trace's camera pictures into a folder, one file each: colour as PNG, depth (1 mm per
/// step) and labels as 16-bit PGM. Prints the count and returns the exit status. Throws ToolError
/// and TraceError.
int write_pictures(const std::string& trace, const std::string& folder);

}  // namespace verp::tool
