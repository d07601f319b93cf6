#pragma once
#include <filesystem>

namespace verp::files {

/// Absolute paths of the source folder and the build tree of this program. Only one file contains
/// them, so that the others compile to the same bytes wherever the project is. In an installed
/// program, source_dir() is share/verp beside the folder of the program or library.
std::filesystem::path source_dir();
std::filesystem::path build_dir();

}  // namespace verp::files
