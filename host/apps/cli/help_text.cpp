#include "host/apps/cli/help_text.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace verp::cli {
namespace {

constexpr std::size_t kColumn = 30;  // column of CLI11's descriptions
constexpr std::size_t kNarrow = 60;
constexpr std::size_t kIndentOfNarrow = 6;
constexpr int kElsewhere = 100, kLeast = 20;

/// The word, or if it does not fit, its longest part that fits and ends with a comma.
std::string_view first_piece(std::string_view word, std::size_t room) {
  if (word.size() <= room) return word;
  const std::size_t comma = word.rfind(',', room - 1);
  return comma == word.npos ? word : word.substr(0, comma + 1);
}

/// `first` and `text` in lines of at most `width`, indented by `indent` from the second.
std::string paragraph(std::string first, std::string_view text, std::size_t indent,
                      std::size_t width) {
  std::string out, line = std::move(first);
  bool bare = line.find_first_not_of(' ') == std::string::npos;
  while (!text.empty()) {
    const std::string_view word = first_piece(text.substr(0, text.find(' ')), width - indent);
    text.remove_prefix(word.size());
    if (text.starts_with(' ')) text.remove_prefix(1);
    if (word.empty()) continue;
    const bool space = !bare && line.back() != ' ';
    if (!bare && line.size() + (space ? 1 : 0) + word.size() > width) {
      while (line.back() == ' ') line.pop_back();
      out += line + '\n';
      line.assign(indent, ' ');
      line += word;
    } else {
      line += (space ? " " : "") + std::string(word);
    }
    bare = false;
  }
  return out + line + '\n';
}

std::string one_line(std::string_view line, std::size_t width) {
  const std::size_t start = std::min(line.find_first_not_of(' '), line.size());
  const bool described =
      start >= 2 && line.size() > kColumn && line[kColumn - 1] == ' ' && line[kColumn] != ' ';
  if (described && width >= kNarrow) {
    return paragraph(std::string(line.substr(0, kColumn)), line.substr(kColumn), kColumn, width);
  }
  if (!described) {
    return paragraph(std::string(start, ' '), line.substr(start), start + (start > 0 ? 2 : 0),
                     width);
  }
  std::string word(line.substr(0, kColumn));
  word.erase(word.find_last_not_of(' ') + 1);
  if (!word.empty()) word = paragraph("  ", word, 4, width);
  return word +
         paragraph(std::string(kIndentOfNarrow, ' '), line.substr(kColumn), kIndentOfNarrow, width);
}

}  // namespace

int help_width() {
  int width = 0;
  winsize size{};
  if (const char* columns = std::getenv("COLUMNS")) width = std::atoi(columns);
  if (width <= 0 && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) width = size.ws_col;
  return width <= 0 ? kElsewhere : std::max(width, kLeast);
}

std::string wrapped_help(std::string_view text, int width) {
  std::string out;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const bool fits = line.size() <= static_cast<std::size_t>(width);
    out += fits ? std::string(line) + '\n' : one_line(line, static_cast<std::size_t>(width));
  }
  return out;
}

}  // namespace verp::cli
