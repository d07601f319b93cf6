#include "host/flash/tool_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "host/flash/flash_error.hpp"

namespace verp::flash {
namespace {

constexpr int kLook_ms = 50;
constexpr int kGrace_looks = 60;  ///< 3 s between the polite end and the other one

/// A child with both its streams in one pipe; it ends with this object at the latest.
class Child {
 public:
  Child(std::vector<std::string> command, const std::string& package) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) fail(command[0], errno, package);
    out_ = ends[0];
    const int error = spawn(std::move(command), ends[1]);
    ::close(ends[1]);
    if (error != 0) {
      ::close(out_);
      fail(program_, error, package);
    }
  }
  ~Child() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    ::close(out_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Appends what comes within kLook_ms. False: nothing will come any more.
  bool read(std::string& output) const {
    pollfd waiting{.fd = out_, .events = POLLIN, .revents = 0};
    if (::poll(&waiting, 1, kLook_ms) <= 0) return true;
    char chunk[4096];
    const ssize_t count = ::read(out_, chunk, sizeof chunk);
    if (count > 0) output.append(chunk, static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
  }
  void tell(int signal) const { ::kill(pid_, signal); }
  int wait() {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

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

  int spawn(std::vector<std::string> command, int output) {
    program_ = command[0];
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int error =
        posix_spawnp(&pid_, arguments[0], &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) pid_ = -1;
    return error;
  }

  std::string program_;
  int out_ = -1;
  pid_t pid_ = -1;
};

/// The number before the last percent sign, as a share; negative when there is none.
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
  Child child(command, package);
  ToolRun run;
  int looks = 0;
  while (child.read(run.output)) {
    const double share = last_share(run.output);
    if (share >= 0) hooks.share(share);
    if (!run.interrupted && !hooks.stop()) continue;
    if (looks++ == 0) child.tell(SIGINT);
    if (looks == kGrace_looks) child.tell(SIGKILL);
    run.interrupted = true;
  }
  run.status = child.wait();
  return run;
}

std::string last_line(const std::string& output) {
  std::size_t end = output.size();
  while (end > 0 && (std::isspace(static_cast<unsigned char>(output[end - 1])) != 0)) --end;
  if (end == 0) return "nothing";
  const std::size_t before = output.find_last_of("\r\n", end - 1);
  const std::size_t begin = before == output.npos ? 0 : before + 1;
  return output.substr(begin, end - begin);
}

}  // namespace verp::flash
