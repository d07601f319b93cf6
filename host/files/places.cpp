#include "host/files/places.hpp"

namespace verp::files {

std::filesystem::path source_dir() {
  return VERP_SOURCE_DIR;
}

std::filesystem::path build_dir() {
  return VERP_BUILD_DIR;
}

}  // namespace verp::files
