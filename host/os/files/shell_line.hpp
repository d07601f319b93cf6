#pragma once
#include <string>
#include <vector>

namespace verp::files {

/// The text as a shell takes it for one word: as it is, or in quotes.
std::string shell_word(const std::string& text);

/// The words as one line that a shell takes apart into the same words.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace verp::files
