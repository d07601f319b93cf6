#include "host/report/files.hpp"

#include <unistd.h>

#include <fstream>

#include "host/report/report.hpp"

namespace verp::report {

void write_file(const std::filesystem::path& file, std::string_view content) {
  std::filesystem::path part = file;
  part += "." + std::to_string(::getpid()) + ".part";
  std::ofstream out(part, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(part, file, error);
  if (out && !error) return;
  std::filesystem::remove(part, error);
  throw ReportError(file.string() +
                    ": cannot be written; choose a folder that exists and is yours, or free space");
}

}  // namespace verp::report
