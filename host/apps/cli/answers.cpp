#include "host/apps/cli/answers.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>

#include "host/apps/cli/interrupt.hpp"

namespace verp::cli {
namespace {

constexpr int kLook_ms = 100;  // longest delay of an interrupt

}  // namespace

std::optional<std::string> Answers::line() {
  for (;;) {
    if (const std::size_t end = read_.find('\n'); end != std::string::npos) {
      const std::string line = read_.substr(0, end);
      read_.erase(0, end + 1);
      return line;
    }
    if (interrupted() || ended_) return std::nullopt;
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, kLook_ms) <= 0) continue;
    std::array<char, 256> piece{};
    const ssize_t count = ::read(STDIN_FILENO, piece.data(), piece.size());
    if (count > 0) {
      read_.append(piece.data(), static_cast<std::size_t>(count));
    } else if (count == 0 || (errno != EINTR && errno != EAGAIN)) {
      ended_ = true;
      if (!read_.empty()) read_ += '\n';  // the last line had no line break
    }
  }
}

std::optional<std::string> Answers::line(const std::string& question) {
  std::fputs(question.c_str(), stderr);
  std::fflush(stderr);
  std::optional<std::string> answer = line();
  if (!answer) std::fputc('\n', stderr);
  return answer;
}

}  // namespace verp::cli
