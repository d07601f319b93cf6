#pragma once
#include <filesystem>
#include <string_view>

namespace verp::report {

/// Creates the folder that `option` named, if missing. Throws ReportError.
void make_folder(const std::filesystem::path& folder, const char* option);

/// Writes a file under a temporary name, then renames it: readers never see a partial file, and two
/// writers never mix. Throws ReportError.
void write_file(const std::filesystem::path& file, std::string_view content);

}  // namespace verp::report
