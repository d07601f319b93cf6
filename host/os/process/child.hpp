#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Programs that we start.
namespace verp::process {

/// Where a program's stream leads: a descriptor of ours that it gets a copy of, or a file, which is
/// made anew if it is written. Neither: nowhere.
struct Stream {
  int descriptor = -1;
  std::filesystem::path file = {};
};

struct Command {
  std::vector<std::string> words;  ///< the program, looked up in PATH, and its arguments
  Stream input, output;
  std::optional<Stream> error = {};   ///< none: where the output goes
  std::filesystem::path folder = {};  ///< where it works; empty: where we do
  /// It ends with the thread that made it, even one of a process that is killed. False: for whoever
  /// is told by its streams that we are gone, and may be made on any thread.
  bool ends_with_thread = true;
};

/// A program that runs beside this one, in a process group of its own: a terminal's Ctrl-C reaches
/// us, who then end it in order. It ends with this object at the latest, and with this process,
/// even one that is killed. Make it on the main thread, unless its command says otherwise: to the
/// kernel, a thread that ends is a parent that died.
class Child {
 public:
  /// Returns when the program runs. Throws std::system_error with the reason when it can't be
  /// started; ENOENT: there is no such program.
  explicit Child(const Command& command);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t id() const { return pid_; }
  /// A signal to it and to what it started.
  void tell(int signal) const;
  /// Its exit status once it has ended, 128 + signal if it was killed. Does not wait.
  std::optional<int> status();
  /// The same; waits.
  int wait();

 private:
  std::optional<int> reap(int flags);

  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// What it said last; "nothing" if it said nothing.
std::string last_line(const std::string& output);

}  // namespace verp::process
