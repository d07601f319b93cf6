#include "host/board/qemu.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>

#include "host/board/board_error.hpp"

namespace verp::board {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(2);

int exit_status(int wait_status) {
  return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
}

/// Starts `command` with its output going to `log`. Returns 0, or the error number.
int spawn(std::vector<std::string> command, const std::filesystem::path& log, pid_t& pid) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  // A group of its own: Ctrl-C must reach us, who then end the run in order, and not the emulator.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error =
      posix_spawnp(&pid, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

std::vector<std::string> QemuProcess::command(const Launch& launch) {
  const char* other = std::getenv("VERP_QEMU");
  std::string semihosting = "enable=on,target=native,arg=" + launch.image.filename().string();
  for (const std::string& argument : launch.arguments) semihosting += ",arg=" + argument;
  std::vector<std::string> command = {other != nullptr ? other : "qemu-system-arm",
                                      "-M",
                                      launch.board.machine,
                                      "-display",
                                      "none",
                                      "-monitor",
                                      "none",
                                      "-semihosting-config",
                                      semihosting,
                                      "-kernel",
                                      launch.image.string()};
  const auto add = [&](const std::string& option, const std::string& value) {
    command.push_back(option);
    command.push_back(value);
  };
  if (launch.serial_ports.empty()) add("-serial", "none");
  for (const auto& port : launch.serial_ports) {
    add("-serial", "unix:" + port.string() + ",server=on,wait=off");
  }
  if (!launch.plugin.empty()) add("-plugin", launch.plugin);
  command.insert(command.end(), launch.options.begin(), launch.options.end());
  return command;
}

QemuProcess::QemuProcess(const Launch& launch) : name_(launch.image.filename().string()) {
  setenv("QEMU_AUDIO_DRV", "none", 1);  // no sound card is looked for
  const std::vector<std::string> words = command(launch);
  const int error = spawn(words, directory_.path() / "output", pid_);
  if (error != 0) {
    pid_ = -1;
    throw BoardError(words[0] + ": can't start the emulator (" + std::strerror(error) +
                     "); install it: apt-get install qemu-system-arm");
  }
}

QemuProcess::~QemuProcess() {
  if (pid_ < 0 || poll_status()) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

std::optional<int> QemuProcess::poll_status() {
  int wait_status = 0;
  if (!status_ && waitpid(pid_, &wait_status, WNOHANG) == pid_) status_ = exit_status(wait_status);
  return status_;
}

int QemuProcess::wait(std::chrono::seconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  while (!poll_status()) {
    if (std::chrono::steady_clock::now() > deadline) {
      throw BoardError(described("still running after " + std::to_string(limit.count()) + " s"));
    }
    std::this_thread::sleep_for(kPollInterval);
  }
  return *status_;
}

void QemuProcess::wait_for_success(std::chrono::seconds limit) {
  const int status = wait(limit);
  if (status != 0) throw BoardError(described("ended with status " + std::to_string(status)));
}

std::string QemuProcess::output() const {
  std::ostringstream text;
  text << std::ifstream(directory_.path() / "output").rdbuf();
  return text.str();
}

std::string QemuProcess::described(const std::string& what) const {
  std::string words = output();
  while (!words.empty() && words.back() == '\n') words.pop_back();
  const std::size_t last_line = words.rfind('\n');
  if (last_line != std::string::npos) words.erase(0, last_line + 1);
  return name_ + ": " + what + "; its last words: " + (words.empty() ? "none" : words);
}

}  // namespace verp::board
