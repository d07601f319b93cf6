#include "host/robot/model/picture_files.hpp"

#include <filesystem>

#include "host/robot/model/find.hpp"

namespace verp::model {

namespace {

namespace fs = std::filesystem;

}  // namespace

std::string PictureFiles::find(const std::string& uri) const {
  const std::size_t scheme = uri.find("://");
  std::string path = scheme == uri.npos ? uri : uri.substr(scheme + 3);
  // onshape-to-robot writes package:///foot.stl, which libsdformat calls model:///foot.stl.
  if (scheme != uri.npos && !uri.starts_with("file:")) path.erase(0, path.find_first_not_of('/'));
  for (const std::string& file : from_) {
    if (const std::string found = resolve_model_uri(uri, file); !found.empty()) return found;
    std::error_code error;
    for (fs::path folder = fs::absolute(file, error).parent_path();;
         folder = folder.parent_path()) {
      const fs::path candidate = folder / path;
      if (!path.empty() && fs::is_regular_file(candidate, error)) return candidate.string();
      if (scheme == uri.npos || folder == folder.root_path() || folder.empty()) break;
    }
  }
  return {};
}

}  // namespace verp::model
