#pragma once
#include <filesystem>
#include <vector>

#include "host/author/action/document.hpp"

namespace verp::action {

/// Where the actions of the robot in this SDF file are: `actions` beside it.
std::filesystem::path folder_of(const std::filesystem::path& robot_file);

/// All *.action files of a folder, by name; none if there is no such folder. Throws LoadError.
std::vector<Document> read_folder(const std::filesystem::path& folder);

/// The action in this file, then those beside it that it leads to: links, exits, mirrors. Throws
/// LoadError.
std::vector<Document> read_with_linked(const std::filesystem::path& file);

}  // namespace verp::action
