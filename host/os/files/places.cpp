#include "host/os/files/places.hpp"

#include <dlfcn.h>

#include <string>

namespace verp::files {
namespace {

namespace fs = std::filesystem;

/// share/verp beside `file` or a parent folder; empty: not found.
fs::path share_beside(const fs::path& file) {
  std::error_code ignored;
  fs::path folder = fs::canonical(file, ignored).parent_path();
  while (folder.has_relative_path()) {
    if (fs::is_directory(folder / "share/verp/common/robots", ignored))
      return folder / "share/verp";
    folder = folder.parent_path();
  }
  return {};
}

fs::path find_source_dir() {
  Dl_info own = {};
  dladdr(reinterpret_cast<void*>(&source_dir), &own);
  for (const char* file : {own.dli_fname, "/proc/self/exe"}) {
    const fs::path share = file == nullptr ? fs::path() : share_beside(file);
    if (!share.empty()) return share;
  }
  return VERP_SOURCE_DIR;
}

}  // namespace

fs::path source_dir() {
  static const fs::path folder = find_source_dir();
  return folder;
}

fs::path build_dir() {
  return VERP_BUILD_DIR;
}

}  // namespace verp::files
