#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/author/action/document.hpp"
#include "host/author/action/poser.hpp"

namespace verp::action {

/// The controller's image, and each frame's source.
struct CompiledActions {
  std::vector<std::uint32_t> words;  ///< aligned
  std::vector<Document> documents;   ///< action 1, 2, ..., by name
  std::vector<int> line;             ///< one per frame

  /// Valid as long as `words`.
  Library library() const { return {words.data(), 4 * words.size()}; }
  /// 0: no such action.
  int number(const std::string& name) const;
  /// Throws LoadError with the names.
  int require(const std::string& name, const std::string& place) const;
};

/// Throws LoadError with file and line for impossible actions and endless links.
CompiledActions make_library(const Params& params, std::vector<Document> documents);

}  // namespace verp::action
