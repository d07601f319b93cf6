#pragma once
#include <string>

namespace verp::tool {

/// Writes camera pictures, one file each: colour as PNG, depth (1 mm per step) and labels as 16-bit
/// PGM. Returns the exit status. Throws ToolError and TraceError.
int write_pictures(const std::string& trace, const std::string& folder);

}  // namespace verp::tool
