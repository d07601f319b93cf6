#pragma once
#include <string>
#include <vector>

namespace verp::files {

/// Text as one shell word, quoted if necessary.
std::string shell_word(const std::string& text);

/// Words as one shell command line.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace verp::files
