#pragma once
#include <filesystem>
#include <string_view>

namespace verp::report {

/// Creates the folder that `option` named, if missing. Throws ReportError.
void make_folder(const std::filesystem::path& folder, const char* option);

/// Written under a temporary name, then renamed: readers never see a partial file. Throws
/// ReportError.
void write_file(const std::filesystem::path& file, std::string_view content);

}  // namespace verp::report
