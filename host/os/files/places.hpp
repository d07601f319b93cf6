#pragma once
#include <filesystem>

namespace verp::files {

/// The project's folder that this program was compiled in, and the build tree; absolute. In one
/// file, so that the others compile to the same bytes wherever the project is. Installed, what it
/// has of the project is in share/verp beside the folder of the program or library.
std::filesystem::path source_dir();
std::filesystem::path build_dir();

}  // namespace verp::files
