#include "host/boards/flash/tool_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <system_error>

#include "host/boards/flash/flash_error.hpp"
#include "host/os/process/child.hpp"

namespace verp::flash {
namespace {

constexpr int kLook_ms = 50;
constexpr int kGrace_looks = 60;  ///< 3 s between SIGINT and SIGKILL

/// A running tool with both streams in one pipe; ends with this object.
class StartedTool {
 public:
  StartedTool(const std::vector<std::string>& command, const std::string& package) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) fail(command[0], errno, package);
    out_ = ends[0];
    try {
      child_.emplace(
          process::Command{.words = command, .input = {}, .output = {.descriptor = ends[1]}});
    } catch (const std::system_error& error) {
      ::close(ends[1]);
      ::close(out_);
      fail(command[0], error.code().value(), package);
    }
    ::close(ends[1]);
  }
  ~StartedTool() { ::close(out_); }
  StartedTool(const StartedTool&) = delete;
  StartedTool& operator=(const StartedTool&) = delete;

  /// Appends the output of the next kLook_ms. False: no more output will come.
  bool read(std::string& output) const {
    pollfd waiting{.fd = out_, .events = POLLIN, .revents = 0};
    if (::poll(&waiting, 1, kLook_ms) <= 0) return true;
    char chunk[4096];
    const ssize_t count = ::read(out_, chunk, sizeof chunk);
    if (count > 0) output.append(chunk, static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
  }
  void tell(int signal) const { child_->tell(signal); }
  int wait() { return child_->wait(); }

 private:
  [[noreturn]] static void fail(const std::string& program, int error, const std::string& package) {
    if (error == ENOENT) {
      throw FlashError(FlashError::Kind::kNoTool,
                       fmt::format("{} is not installed; install it: sudo apt-get install {}",
                                   program, package));
    }
    throw FlashError(FlashError::Kind::kNoTool,
                     fmt::format("{}: cannot be started ({}); look at it with: which {}", program,
                                 std::strerror(error), program));
  }

  int out_ = -1;
  std::optional<process::Child> child_;
};

/// The number before the last percent sign; negative: none.
double last_share(const std::string& output) {
  const std::size_t sign = output.rfind('%');
  if (sign == output.npos) return -1;
  const std::size_t before = output.find_last_not_of("0123456789.", sign == 0 ? 0 : sign - 1);
  const std::size_t begin = before == output.npos ? 0 : before + 1;
  return begin >= sign ? -1 : std::atof(output.substr(begin, sign - begin).c_str()) / 100;
}

}  // namespace

ToolRun run_tool(const std::vector<std::string>& command, const std::string& package,
                 const ToolHooks& hooks) {
  StartedTool tool(command, package);
  ToolRun run;
  int looks = 0;
  while (tool.read(run.output)) {
    const double share = last_share(run.output);
    if (share >= 0) hooks.share(share);
    if (!run.interrupted && !hooks.stop()) continue;
    if (looks++ == 0) tool.tell(SIGINT);
    if (looks == kGrace_looks) tool.tell(SIGKILL);
    run.interrupted = true;
  }
  run.status = tool.wait();
  return run;
}

}  // namespace verp::flash
