#include "host/apps/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace verp::cli {

Progress::Progress(bool wanted)
    : active_(wanted && ::isatty(STDERR_FILENO) != 0 && std::getenv("CI") == nullptr) {}

void Progress::show(double share, const std::string& label) {
  const auto now = std::chrono::steady_clock::now();
  if (!active_ || (drawn_ && now < next_)) return;
  next_ = now + std::chrono::milliseconds(100);
  constexpr int kWidth = 32;
  const int full = static_cast<int>(std::clamp(share, 0.0, 1.0) * kWidth);
  std::string bar;
  for (int i = 0; i < kWidth; ++i) bar += i < full ? "█" : "░";
  // A closed terminal must not end a run.
  std::fputs(fmt::format("\r\033[K{} {:3.0f} %  {}", bar, 100 * std::clamp(share, 0.0, 1.0), label)
                 .c_str(),
             stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::clear() {
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

}  // namespace verp::cli
