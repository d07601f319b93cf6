#include "host/action/folder.hpp"

#include <algorithm>

namespace verp::action {

std::filesystem::path folder_of(const std::filesystem::path& robot_file) {
  return robot_file.parent_path() / "actions";
}

std::vector<Document> read_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".action") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Document> documents;
  for (const auto& file : files) documents.push_back(read_document(file));
  return documents;
}

}  // namespace verp::action
