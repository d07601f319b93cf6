#pragma once
#include <filesystem>
#include <string_view>

namespace verp::report {

/// The folder that `option` named, made if need be. Throws ReportError.
void make_folder(const std::filesystem::path& folder, const char* option);

/// Writes a whole file under a name of its own, then renames it: a reader never sees half of it,
/// and two writers never mix. Throws ReportError.
void write_file(const std::filesystem::path& file, std::string_view content);

}  // namespace verp::report
