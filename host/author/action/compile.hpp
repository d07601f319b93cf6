#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/author/action/document.hpp"
#include "host/author/action/poser.hpp"

namespace verp::action {

/// Actions made for a robot: the image that its controller reads, and where each frame comes from.
struct Made {
  std::vector<std::uint32_t> words;  ///< the image, aligned
  std::vector<Document> documents;   ///< of action 1, 2, ...: by name
  std::vector<int> line;             ///< of each frame

  /// Valid while `words` are.
  Library library() const { return {words.data(), 4 * words.size()}; }
  /// Number of the action; 0: there is none of that name.
  int number(const std::string& name) const;
  /// Throws LoadError with the names there are.
  int require(const std::string& name, const std::string& place) const;
};

/// Throws LoadError with file and line for what this robot lacks or cannot do, and for links that
/// never end.
Made make_library(const Params& params, std::vector<Document> documents);

}  // namespace verp::action
