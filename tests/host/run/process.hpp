#pragma once
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "tests/host/tool/program.hpp"

namespace verp::tool::test {

/// A program of the test's own that runs beside it; ends with this object at the latest.
class Process {
 public:
  /// Its outputs go to files `name`.out and .err of the folder; it reads what is typed.
  Process(const fs::path& folder, const std::string& name, std::vector<std::string> arguments)
      : out_(folder / (name + ".out")), err_(folder / (name + ".err")) {
    ::signal(SIGPIPE, SIG_IGN);  // of one that no longer reads
    fs::remove(out_);            // of one of that name before
    fs::remove(err_);
    int keyboard[2] = {-1, -1};
    if (::pipe2(keyboard, O_CLOEXEC) != 0) return;
    arguments.insert(arguments.begin(), VERP_PROGRAM);
    std::vector<char*> words;
    for (std::string& word : arguments) words.push_back(word.data());
    words.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ != 0) {
      ::close(keyboard[0]);
      keyboard_ = keyboard[1];
      return;
    }
    if (::chdir(folder.c_str()) != 0 || ::dup2(keyboard[0], STDIN_FILENO) < 0) ::_exit(126);
    redirect(out_, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(err_, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    ::execv(words[0], words.data());
    ::_exit(127);
  }
  ~Process() {
    hang_up();
    if (pid_ <= 0 || ended_) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void type(const std::string& text) const {
    if (::write(keyboard_, text.data(), text.size()) < 0) ADD_FAILURE() << "nobody reads";
  }
  /// Nothing more will be typed.
  void hang_up() {
    if (keyboard_ >= 0) ::close(keyboard_);
    keyboard_ = -1;
  }
  void signal(int number) const { ::kill(pid_, number); }
  /// Stops it for a while; returns for how long it surely stood still.
  std::uint64_t stand_still_us(std::uint64_t time_us) {
    ::kill(pid_, SIGSTOP);
    int status = 0;
    if (::waitpid(pid_, &status, WUNTRACED) != pid_ || !WIFSTOPPED(status)) {
      ended_ = true;
      return 0;
    }
    const auto begun = std::chrono::steady_clock::now();
    std::this_thread::sleep_for(std::chrono::microseconds(time_us));
    const auto stood = std::chrono::steady_clock::now() - begun;
    ::kill(pid_, SIGCONT);
    return static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::microseconds>(stood).count());
  }
  /// Waits until standard error says `needle`, after what it was seen to say before; false: it
  /// ended, or two minutes have passed.
  bool says(const std::string& needle) {
    for (int i = 0; i < 12000; ++i) {
      const bool last = over();
      const std::size_t at = slurp(err_).find(needle, seen_);
      if (at != std::string::npos) {
        seen_ = at + needle.size();
        return true;
      }
      if (last) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  bool over() {
    int status = 0;
    if (!ended_ && ::waitpid(pid_, &status, WNOHANG) == pid_) note(status);
    return ended_;
  }
  Outcome wait() {
    int status = 0;
    if (!ended_ && ::waitpid(pid_, &status, 0) == pid_) note(status);
    return {status_, slurp(out_), slurp(err_)};
  }

 private:
  static void redirect(const fs::path& file, int flags, int stream) {
    const int descriptor = ::open(file.c_str(), flags, 0600);
    if (descriptor < 0 || ::dup2(descriptor, stream) < 0) ::_exit(126);
  }
  void note(int status) {
    ended_ = true;
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  fs::path out_, err_;
  pid_t pid_ = -1;
  int keyboard_ = -1;
  std::size_t seen_ = 0;  ///< of standard error
  int status_ = -1;
  bool ended_ = false;
};

}  // namespace verp::tool::test
