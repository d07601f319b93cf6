#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/author/action/document.hpp"
#include "host/author/action/poser.hpp"

namespace verp::action {

/// Compiled actions: the image for a controller, and each frame's source.
struct CompiledActions {
  std::vector<std::uint32_t> words;  ///< aligned
  std::vector<Document> documents;   ///< of action 1, 2, ...: by name
  std::vector<int> line;             ///< one per frame

  /// Valid as long as `words`.
  Library library() const { return {words.data(), 4 * words.size()}; }
  /// 0: no such action.
  int number(const std::string& name) const;
  /// Throws LoadError that lists the names.
  int require(const std::string& name, const std::string& place) const;
};

/// Compiles a robot's actions. Throws LoadError with file and line for what the robot cannot do,
/// and for endless links.
CompiledActions make_library(const Params& params, std::vector<Document> documents);

}  // namespace verp::action
