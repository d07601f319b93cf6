#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace verp::process {

/// Source or target of a program's stream: a copy of our descriptor, or a file, which is created or
/// truncated for output. Neither: /dev/null.
struct Stream {
  int descriptor = -1;
  std::filesystem::path file = {};
};

struct Command {
  std::vector<std::string> words;  ///< the program, searched in PATH, and its arguments
  Stream input, output;
  std::optional<Stream> error = {};   ///< none: same as the output
  std::filesystem::path folder = {};  ///< working directory; empty: ours
  /// The program ends with the thread that started it, even in a killed process. False: for
  /// programs that notice our end by their streams; any thread may start them.
  bool ends_with_thread = true;
};

/// A child process in its own process group. A terminal's Ctrl-C reaches only us, and we then end
/// the child in order. It ends at the latest with this object or this process, even a killed one.
/// Create it on the main thread unless the command says otherwise: to the kernel, a thread that
/// ends is a parent that died.
class Child {
 public:
  /// Returns when the program runs. Throws std::system_error with the reason if it cannot start;
  /// ENOENT: there is no such program.
  explicit Child(const Command& command);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t id() const { return pid_; }
  /// Sends a signal to the process group.
  void tell(int signal) const;
  /// Exit status after the end; 128 + signal if killed. Does not wait.
  std::optional<int> status();
  int wait();

 private:
  std::optional<int> reap(int flags);

  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// Last line of the output; "nothing" if it is empty.
std::string last_line(const std::string& output);

}  // namespace verp::process
