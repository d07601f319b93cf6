#pragma once
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "host/os/process/child.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {

class Process {
 public:
  /// Output goes to `name`.out and .err.
  Process(const fs::path& folder, const std::string& name, std::vector<std::string> arguments)
      : out_(folder / (name + ".out")), err_(folder / (name + ".err")) {
    ::signal(SIGPIPE, SIG_IGN);  // the program may stop reading
    fs::remove(out_);
    fs::remove(err_);
    int keyboard[2] = {-1, -1};
    if (::pipe2(keyboard, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    keyboard_ = keyboard[1];
    arguments.insert(arguments.begin(), VERP_PROGRAM);
    child_.emplace(process::Command{.words = std::move(arguments),
                                    .input = {.descriptor = keyboard[0]},
                                    .output = {.file = out_},
                                    .error = process::Stream{.file = err_},
                                    .folder = folder});
    ::close(keyboard[0]);
  }
  ~Process() { hang_up(); }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void type(const std::string& text) const {
    if (::write(keyboard_, text.data(), text.size()) < 0) ADD_FAILURE() << "nobody reads";
  }
  void hang_up() {
    if (keyboard_ >= 0) ::close(keyboard_);
    keyboard_ = -1;
  }
  void signal(int number) const { child_->tell(number); }
  /// Returns a lower bound of the real standstill.
  std::uint64_t stand_still_us(std::uint64_t time_us) {
    child_->tell(SIGSTOP);
    siginfo_t stopped{};
    if (::waitid(P_PID, static_cast<id_t>(child_->id()), &stopped, WSTOPPED | WEXITED | WNOWAIT) !=
            0 ||
        stopped.si_code != CLD_STOPPED)
      return 0;
    const auto begun = std::chrono::steady_clock::now();
    std::this_thread::sleep_for(std::chrono::microseconds(time_us));
    const auto stood = std::chrono::steady_clock::now() - begun;
    child_->tell(SIGCONT);
    return static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::microseconds>(stood).count());
  }
  /// Waits for `needle` after the last match; false if the program ended. ctest's timeout applies.
  bool says(const std::string& needle) {
    for (;;) {
      const bool last = over();
      const std::size_t at = slurp(err_).find(needle, seen_);
      if (at != std::string::npos) {
        seen_ = at + needle.size();
        return true;
      }
      if (last) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  std::string said() const { return slurp(err_); }
  /// Simulates a full disk: no file grows further.
  void fill_disk(rlim_t most_bytes) const {
    const rlimit limit{most_bytes, most_bytes};
    ASSERT_EQ(::prlimit(child_->id(), RLIMIT_FSIZE, &limit, nullptr), 0);
  }
  bool over() { return child_->status().has_value(); }
  Outcome wait() {
    const int status = child_->wait();
    return {status, slurp(out_), slurp(err_)};  // 128 and more: a signal
  }

 private:
  fs::path out_, err_;
  std::optional<process::Child> child_;
  int keyboard_ = -1;
  std::size_t seen_ = 0;  ///< of standard error
};

}  // namespace verp::tool::test
