#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace verp::model {

bool is_file(const std::filesystem::path& path);

/// A path, or NAME: NAME/KIND.sdf in one of `folders`.
struct NamedFiles {
  std::string kind;
  std::vector<std::filesystem::path> folders;

  std::vector<std::string> names() const;
  /// Throws LoadError with the existing names.
  std::string find(const std::string& name_or_path) const;
};

}  // namespace verp::model
