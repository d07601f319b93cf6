#pragma once
#include <string>

namespace verp::tool {

/// Writes what a trace's cameras saw into a folder, a file a picture: colour as PNG, depth (1 mm a
/// step) and labels as PGM of 16 bits; tells how many. Returns the exit status. Throws ToolError
/// and TraceError.
int write_pictures(const std::string& trace, const std::string& folder);

}  // namespace verp::tool
