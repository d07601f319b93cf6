#include "host/tool/interrupt.hpp"

#include <csignal>
#include <ctime>

namespace verp::tool {
namespace {

volatile std::sig_atomic_t asked = 0;
volatile std::time_t asked_at_s = 0;

// One press may arrive twice: from the terminal and from a program that passes it on (`timeout`
// and, of a closed terminal, the shell do so).
constexpr std::time_t kSamePress_s = 2;

extern "C" void ask(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (asked != 0 && now.tv_sec - asked_at_s >= kSamePress_s) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  if (asked == 0) asked_at_s = now.tv_sec;
  asked = 1;
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

bool interrupted() {
  return asked != 0;
}

}  // namespace verp::tool
