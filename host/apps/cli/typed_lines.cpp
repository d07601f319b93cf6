#include "host/apps/cli/typed_lines.hpp"

#include <poll.h>
#include <unistd.h>

namespace verp::cli {

std::string TypedLines::next() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  while (open_ && begun_.find('\n') == std::string::npos && poll(&input, 1, 0) > 0) {
    // Reading in the background would stop this program.
    if (isatty(STDIN_FILENO) != 0 && tcgetpgrp(STDIN_FILENO) != getpgrp()) return "";
    char piece[256];
    const ssize_t count = read(STDIN_FILENO, piece, sizeof piece);
    open_ = count > 0;
    if (open_) begun_.append(piece, static_cast<std::size_t>(count));
  }
  const std::size_t end = begun_.find('\n');
  if (end == std::string::npos) return "";
  const std::string line = begun_.substr(0, end);
  begun_.erase(0, end + 1);
  return line;
}

}  // namespace verp::cli
