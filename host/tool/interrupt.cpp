#include "host/tool/interrupt.hpp"

#include <csignal>

namespace verp::tool {
namespace {

volatile std::sig_atomic_t asked = 0;

extern "C" void ask(int signal) {
  asked = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, ask);
  std::signal(SIGTERM, ask);
  std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted() {
  return asked != 0;
}

}  // namespace verp::tool
