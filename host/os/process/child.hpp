#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace verp::process {

/// A copy of our descriptor, or a file, truncated for output. Neither: /dev/null.
struct Stream {
  int descriptor = -1;
  std::filesystem::path file = {};
};

struct Command {
  std::vector<std::string> words;  ///< the program, searched in PATH, and arguments
  Stream input, output;
  std::optional<Stream> error = {};   ///< none: as the output
  std::filesystem::path folder = {};  ///< working directory; empty: ours
  /// Ends with its starting thread, even in a killed process. False: it notices our end by its
  /// streams; any thread may start it.
  bool ends_with_thread = true;
};

/// The child has its own process group: Ctrl-C reaches only us, and we end it in order. It ends
/// with this object or process, even a killed one. Create it on the main thread unless the command
/// says otherwise: to the kernel, an ending thread is a dead parent.
class Child {
 public:
  /// Returns when the program runs. Throws std::system_error if it cannot start; ENOENT: no such
  /// program.
  explicit Child(const Command& command);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t id() const { return pid_; }
  void tell(int signal) const;
  /// Exit status, or 128 + signal; nothing while it runs; does not wait.
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
