#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace verp::model {

bool is_file(const std::filesystem::path& path);

/// Files that a person gives as a path, or as a name NAME that stands for NAME/KIND.sdf in one of
/// some folders: robots and worlds.
struct NamedFiles {
  std::string kind;
  std::vector<std::filesystem::path> folders;

  /// Those that are there, sorted.
  std::vector<std::string> names() const;
  /// Throws LoadError with what is wrong, and the names that exist.
  std::string find(const std::string& name_or_path) const;
};

}  // namespace verp::model
