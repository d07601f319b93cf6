#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/author/action/document.hpp"
#include "host/author/action/poser.hpp"

namespace verp::action {

/// A robot's compiled actions: the image for its controller, and the source of each frame.
struct Made {
  std::vector<std::uint32_t> words;  ///< the image, aligned
  std::vector<Document> documents;   ///< of action 1, 2, ...: sorted by name
  std::vector<int> line;             ///< one per frame

  /// Valid as long as `words`.
  Library library() const { return {words.data(), 4 * words.size()}; }
  /// The action's number; 0: no action has that name.
  int number(const std::string& name) const;
  /// Throws LoadError that lists the names.
  int require(const std::string& name, const std::string& place) const;
};

/// Throws LoadError with file and line for what this robot lacks or cannot do, and for links that
/// never end.
Made make_library(const Params& params, std::vector<Document> documents);

}  // namespace verp::action
