#include "host/author/action/folder.hpp"

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

namespace {

std::vector<std::string> targets_of(const Document& document) {
  std::vector<std::string> names;
  const auto add = [&](const std::optional<Target>& target) {
    if (target) names.push_back(target->name);
  };
  add(document.mirror);
  add(document.link);
  for (const FrameText& frame : document.frames) {
    add(frame.exit);
    if (frame.wait) add(frame.wait->otherwise);
  }
  return names;
}

}  // namespace

std::vector<Document> read_with_linked(const std::filesystem::path& file) {
  std::vector<Document> found = {read_document(file)};
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const std::string& name : targets_of(found[i])) {
      const auto known = [&](const Document& each) { return each.name == name; };
      if (std::any_of(found.begin(), found.end(), known)) continue;
      const std::filesystem::path beside = file.parent_path() / (name + ".action");
      if (!std::filesystem::is_regular_file(beside)) continue;
      Document linked = read_document(beside);
      if (linked.name == name) found.push_back(std::move(linked));
    }
  }
  return found;
}

}  // namespace verp::action
