#include "host/run/own/loaded.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "common/model/counts.hpp"
#include "host/run/own/module.hpp"

namespace verp::own {
namespace {

/// The thread is inside that folder's controller.
class Inside {
 public:
  Inside(const char* folder, std::uint32_t tick);
  ~Inside();
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
};

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

/// A crash inside a user's controller then prints one line and exits with 1.
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

constexpr double kDegrees = 180 / 3.14159265358979323846;

const Module& module_at(const void* place) {
  return *static_cast<const Module*>(place);
}

std::string refused(const std::string& folder, const Params& params, int joint, std::uint32_t tick,
                    std::int32_t count) {
  const JointParams& of = params.joint[joint];
  constexpr auto kNoNumber = INT32_MIN;
  const std::string goal = count == kNoNumber
                               ? "not a number"
                               : fmt::format("{} counts ({:.1f} degrees)", count,
                                             kDegrees * double{model::angle_of(of, count)});
  return fmt::format(
      "{}: at tick {} the controller's goal for {} is {}, and the joint goes from "
      "{:.1f} to {:.1f} degrees; mend controller.cpp",
      folder, tick, of.name, goal, kDegrees * double{of.lower_rad},
      kDegrees * double{of.upper_rad});
}

}  // namespace

Loaded::Loaded(const std::filesystem::path& folder, const std::filesystem::path& file)
    : folder_(folder.string()), library_(::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (library_ == nullptr) throw OwnError(fmt::format("{}: {}", folder_, ::dlerror()));
  module_ = ::dlsym(library_, "verp_own_module");
  const bool fits = module_ != nullptr && module_at(module_).params_bytes == sizeof(Params) &&
                    module_at(module_).state_bytes == sizeof(State) &&
                    module_at(module_).inputs_bytes == sizeof(Inputs) &&
                    module_at(module_).outputs_bytes == sizeof(Outputs);
  if (!fits) {
    ::dlclose(library_);
    throw OwnError(file.string() +
                   ": is no controller of this program's revision; remove the "
                   "folder build/ beside its sources");
  }
  name_crashes();
}

Loaded::~Loaded() {
  ::dlclose(library_);
}

session::Decide Loaded::controller(const std::shared_ptr<const Loaded>& loaded) {
  const Module& module = module_at(loaded->module_);
  const std::shared_ptr<void> self(module.make(),
                                   [loaded, &module](void* made) { module.unmake(made); });
  if (self == nullptr) throw OwnError(loaded->folder_ + ": no memory for a controller");
  return [loaded, &module, self](const Params& params, State& state, const Inputs& inputs,
                                 Outputs& outputs) {
    std::int32_t count = 0;
    int joint = 0;
    {
      const Inside inside(loaded->folder_.c_str(), inputs.tick);
      joint = module.decide(self.get(), &params, &state, &inputs, &outputs, &count);
    }
    if (joint >= 0) throw OwnError(refused(loaded->folder_, params, joint, inputs.tick, count));
  };
}

}  // namespace verp::own
