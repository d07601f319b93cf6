#pragma once
#include <string>
#include <vector>

namespace verp::files {

std::string shell_word(const std::string& text);

std::string shell_line(const std::vector<std::string>& words);

}  // namespace verp::files
