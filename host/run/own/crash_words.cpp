#include "host/run/own/crash_words.hpp"

#include <signal.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <memory>

namespace verp::own {
namespace {

thread_local const char* volatile inside_folder = nullptr;
thread_local volatile std::uint32_t inside_tick = 0;

const char* before_line = "";  ///< on a terminal, ends a progress bar

constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

const char* words_of(int signal) {
  switch (signal) {
    case SIGSEGV:
    case SIGBUS:
      return "memory that is not its own, or no stack left";
    case SIGFPE:
      return "an integer divided by 0";
    case SIGABRT:
      return "it gave up (abort)";
    default:
      return "an illegal instruction: a function that returns nothing, or was never written";
  }
}

/// Async-signal-safe output.
class Line {
 public:
  void add(const char* text) {
    for (; *text != 0 && length_ < sizeof text_; ++text) text_[length_++] = *text;
  }
  void add(std::uint32_t number) {
    char digits[11] = {};
    std::size_t at = sizeof digits - 1;
    do {
      digits[--at] = static_cast<char>('0' + number % 10);
      number /= 10;
    } while (number != 0);
    add(digits + at);
  }
  void write() const {
    if (::write(STDERR_FILENO, text_, length_) < 0) return;
  }

 private:
  char text_[1024];
  std::size_t length_ = 0;
};

extern "C" void crashed(int signal) {
  if (inside_folder == nullptr) {
    ::signal(signal, SIG_DFL);
    ::raise(signal);
    return;
  }
  constexpr int kRunFailed = 1;
  Line line;
  line.add(before_line);
  line.add(inside_folder);
  line.add(": the controller crashed at tick ");
  line.add(inside_tick);
  line.add(": ");
  line.add(words_of(signal));
  line.add("; mend controller.cpp, or look with gdb: build/pc/controller_test is a small way in\n");
  line.write();
  ::_exit(kRunFailed);
}

/// A stack overflow's handler needs its own stack.
void give_thread_a_second_stack() {
  constexpr std::size_t kBytes = 1 << 16;
  thread_local std::unique_ptr<char[]> memory;
  if (memory) return;
  memory = std::make_unique<char[]>(kBytes);
  stack_t stack = {};
  stack.ss_sp = memory.get();
  stack.ss_size = kBytes;
  ::sigaltstack(&stack, nullptr);
}

}  // namespace

void name_crashes() {
  give_thread_a_second_stack();
  if (::isatty(STDERR_FILENO) != 0) before_line = "\n";
  struct sigaction action = {};
  action.sa_handler = crashed;
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  for (const int signal : kSignals) ::sigaction(signal, &action, nullptr);
}

Inside::Inside(const char* folder, std::uint32_t tick) {
  inside_tick = tick;
  inside_folder = folder;
}

Inside::~Inside() {
  inside_folder = nullptr;
}

}  // namespace verp::own
