#include "host/apps/cli/interrupt.hpp"

#include <csignal>
#include <cstdint>
#include <ctime>

#include "host/apps/cli/exit_status.hpp"

namespace verp::cli {
namespace {

volatile std::sig_atomic_t asked = 0;
volatile std::sig_atomic_t asked_by = 0;
volatile std::sig_atomic_t to_the_end = 0;
volatile std::int64_t asked_at_ms = 0;

// One press may arrive twice: from the terminal, and from a program that forwards it.
constexpr std::int64_t kSamePress_ms = 2000;
// Shorter: a robot must be released soon.
constexpr std::int64_t kSamePressOfRobot_ms = 300;

extern "C" void ask(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t now_ms = std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1'000'000;
  if (asked == 0) {
    asked_at_ms = now_ms;
    asked_by = signal;
    asked = 1;
  } else if (to_the_end != 0) {
    if (now_ms - asked_at_ms >= kSamePressOfRobot_ms) asked = 2;
  } else if (now_ms - asked_at_ms >= kSamePress_ms) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

void keep_failing_writes() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void catch_interrupts() {
  std::signal(SIGINT, ask);
  std::signal(SIGTERM, ask);
  if (std::signal(SIGHUP, ask) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

void catch_interrupts_to_the_end() {
  to_the_end = 1;
  catch_interrupts();
}

int presses() {
  return static_cast<int>(asked);
}

int status_if_interrupted(int status) {
  return status == kRunFailed && asked_by != 0 ? 128 + static_cast<int>(asked_by) : status;
}

bool interrupted() {
  return asked != 0;
}

}  // namespace verp::cli
