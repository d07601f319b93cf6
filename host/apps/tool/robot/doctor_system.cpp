#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

#include "host/apps/cli/real_time.hpp"
#include "host/apps/tool/robot/doctor_checks.hpp"

namespace verp::tool {
namespace {

/// The first word behind `name` in a line of the file; empty: there is no such line.
std::string word_of(const Machine& machine, const char* file, const std::string& name) {
  std::istringstream lines(machine.read(file));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(name)) continue;
    std::istringstream words(line.substr(name.size()));
    std::string soft;
    words >> soft;
    return soft;
  }
  return "";
}

/// The soft limit.
std::string limit(const Machine& machine, const std::string& name) {
  return word_of(machine, "/proc/self/limits", name);
}

/// Capabilities that no limit binds (capabilities(7)): CAP_IPC_LOCK is 14, CAP_SYS_NICE 23.
bool is_privileged(const Machine& machine) {
  constexpr unsigned long long kBoth = 1ULL << 14 | 1ULL << 23;
  const std::string mask = word_of(machine, "/proc/self/status", "CapEff:");
  return word_of(machine, "/proc/self/status", "Uid:") == "0" &&
         (std::strtoull(mask.c_str(), nullptr, 16) & kBoth) == kBoth;
}

/// Why nothing can be drawn there; empty: something can.
std::string display_trouble(const Machine& machine) {
  const std::string wayland = machine.variable("WAYLAND_DISPLAY");
  if (!wayland.empty()) {
    const std::string folder = machine.variable("XDG_RUNTIME_DIR");
    const std::string socket = wayland.starts_with('/') ? wayland : folder + "/" + wayland;
    if (machine.exists(socket)) return "";
  }
  const std::string display = machine.variable("DISPLAY");
  if (display.empty() && wayland.empty()) return "there is no display";
  if (display.empty()) return fmt::format("WAYLAND_DISPLAY is {}, and nothing is there", wayland);
  if (!display.starts_with(':')) return "";  // another machine's
  const std::string number = display.substr(1, display.find('.') - 1);
  if (machine.exists("/tmp/.X11-unix/X" + number)) return "";
  return fmt::format("DISPLAY is {}, and no X server is there", display);
}

}  // namespace

void check_other_programs(const Machine& machine, Findings& found) {
  const std::size_t before = found.size();
  for (const RunningProgram& each : machine.programs()) {
    const bool ours = each.name == "verp" || each.name.starts_with("verp_");
    if (!ours || each.name.find("test") != std::string::npos) continue;
    found.advise("other verp", fmt::format("process {} runs: {}", each.id, each.command),
                 fmt::format("kill -INT {}  # if it is not wanted", each.id));
  }
  if (found.size() == before) found.good("other verp", "no other verp runs");
}

void check_display(const Machine& machine, Findings& found) {
  const std::string trouble = display_trouble(machine);
  if (trouble.empty()) return found.good("display", "there is one for verp view");
  found.advise("display", trouble + "; only verp view needs one: walk, shot and video work without",
               "ssh -X HOST  # or log in at the desktop");
}

void check_real_time(const Machine& machine, Findings& found) {
  const std::string priority = limit(machine, "Max realtime priority");
  const std::string memory = limit(machine, "Max locked memory");
  const bool fast = priority == "unlimited" || std::atoi(priority.c_str()) >= cli::kLoopPriority;
  if ((fast && memory == "unlimited") || is_privileged(machine)) {
    return found.good("real time", "priority and locked memory are allowed");
  }
  const std::string which = fast                    ? "locked memory"
                            : memory == "unlimited" ? "real-time priority"
                                                    : "real-time priority and locked memory";
  found.advise("real time",
               fmt::format("{} {} not allowed here: verp run and hil may miss ticks", which,
                           fast || memory == "unlimited" ? "is" : "are"),
               fmt::format("printf '@dialout - rtprio {}\\n@dialout - memlock unlimited\\n' | sudo "
                           "tee /etc/security/limits.d/verp.conf && sudo usermod -aG dialout {}  # "
                           "then log in again",
                           cli::kLoopPriority, machine.user()));
}

}  // namespace verp::tool
