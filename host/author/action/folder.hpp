#pragma once
#include <filesystem>
#include <vector>

#include "host/author/action/document.hpp"

namespace verp::action {

/// `actions` beside the robot's file.
std::filesystem::path folder_of(const std::filesystem::path& robot_file);

/// All *.action files, by name. Throws LoadError.
std::vector<Document> read_folder(const std::filesystem::path& folder);

/// This action, then those that its links, exits and mirrors need. Throws LoadError.
std::vector<Document> read_with_linked(const std::filesystem::path& file);

}  // namespace verp::action
