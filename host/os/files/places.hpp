#pragma once
#include <filesystem>

namespace verp::files {

/// Absolute paths of this program's sources and build tree. Only one file has them, so the others
/// compile to the same bytes anywhere. Installed, source_dir() is share/verp beside the program's
/// folder.
std::filesystem::path source_dir();
std::filesystem::path build_dir();

}  // namespace verp::files
