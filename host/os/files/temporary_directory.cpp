#include "host/os/files/temporary_directory.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

namespace verp::files {

TemporaryDirectory::TemporaryDirectory() {
  std::error_code error;
  const std::filesystem::path wanted = std::filesystem::temp_directory_path(error);
  for (const std::filesystem::path& parent : {wanted, std::filesystem::path("/tmp")}) {
    std::string name = (parent / "verp-XXXXXX").string();
    if (parent.empty() || mkdtemp(name.data()) == nullptr) continue;
    path_ = name;
    return;
  }
  throw FileError("/tmp: can't make a temporary directory (" + std::string(std::strerror(errno)) +
                  "); point TMPDIR at a writable one");
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace verp::files
