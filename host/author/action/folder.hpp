#pragma once
#include <filesystem>
#include <vector>

#include "host/author/action/document.hpp"

namespace verp::action {

/// The folder `actions` beside a robot's SDF file.
std::filesystem::path folder_of(const std::filesystem::path& robot_file);

/// All *.action files, by name; empty if there is no such folder. Throws LoadError.
std::vector<Document> read_folder(const std::filesystem::path& folder);

/// The action in this file, then those that its links, exits and mirrors need. Throws LoadError.
std::vector<Document> read_with_linked(const std::filesystem::path& file);

}  // namespace verp::action
