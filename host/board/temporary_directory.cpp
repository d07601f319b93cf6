#include "host/board/temporary_directory.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "host/board/board_error.hpp"

namespace verp::board {

TemporaryDirectory::TemporaryDirectory() {
  std::error_code error;
  std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error) parent = "/tmp";
  std::string name = (parent / "verp-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw BoardError(parent.string() + ": can't make a temporary directory (" +
                     std::strerror(errno) + "); point TMPDIR at a writable one");
  }
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace verp::board
