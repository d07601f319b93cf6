#include "host/study/report/files.hpp"

#include "host/os/files/whole.hpp"
#include "host/study/report/report.hpp"

namespace verp::report {

void make_folder(const std::filesystem::path& folder, const char* option) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (std::filesystem::is_directory(folder, error)) return;
  throw ReportError(folder.string() + ": not a folder and cannot be made; choose another with " +
                    option);
}

void write_file(const std::filesystem::path& file, std::string_view content) {
  const files::Trouble trouble = files::replace(file, content);
  if (trouble.any()) throw ReportError(file.string() + ": " + trouble.text());
}

}  // namespace verp::report
