#include <fmt/format.h>

#include <set>
#include <sstream>

#include "host/apps/tool/robot/doctor_checks.hpp"

namespace verp::tool {
namespace {

constexpr std::uint64_t kMegabyte = 1'000'000;
constexpr std::uint64_t kWalk_MB = 100;    // report and trace of long walks
constexpr std::uint64_t kBuild_MB = 2000;  // build tree with tests

/// Stages of toolchains/packages.txt and the commands that need them, as in ./verp.
constexpr const char* kStages[][2] = {{"run", "every command"},
                                      {"mesh", "verp edit, view, shot, video"},
                                      {"shot", "verp shot, video, view, walk --cameras"},
                                      {"view", "verp view"},
                                      {"manual", "verp manual"},
                                      {"fw", "verp flash, deploy and emulated boards"},
                                      {"python", "verp python"},
                                      {"debug", "verp debug"},
                                      {"bench", "verp bench"},
                                      {"screen", "verp bench --only window"},
                                      {"test", "verp test"}};

constexpr const char* kVariables[][2] = {
    {"LD_PRELOAD", "puts another library into every program, also into verp"},
    {"LD_LIBRARY_PATH", "makes verp load libraries from there and not Debian's"},
    {"CCACHE_DISABLE", "switches ccache off: each build compiles everything"},
    {"CCACHE_SLOPPINESS", "lets ccache take an object that does not fit its sources"},
    {"CCACHE_PREFIX", "makes ccache start another program in place of the compiler"},
    {"CI", "makes ./verp install packages without a question"},
    {"VERP_ROBOT_PATH", "makes verp look there for robots first"}};

std::set<std::string> installed_packages(const Machine& machine) {
  std::istringstream status(machine.read("/var/lib/dpkg/status"));
  std::set<std::string> installed;
  std::string name;
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("Package: ")) name = line.substr(9);
    if (line.starts_with("Status: ") && line.ends_with(" ok installed")) installed.insert(name);
  }
  return installed;
}

std::string missing_of(const std::string& stage, const std::string& list,
                       const std::set<std::string>& installed) {
  std::istringstream lines(list);
  std::string missing;
  for (std::string line, first, package; std::getline(lines, line);) {
    std::istringstream words(line);
    if (!(words >> first >> package) || first != stage || installed.contains(package)) continue;
    missing += " " + package;
  }
  return missing;
}

/// Folders that a variable names and that are not there.
void check_folders(const Machine& machine, const std::string& variable, Findings& found) {
  std::istringstream folders(machine.variable(variable));
  for (std::string each; std::getline(folders, each, ':');) {
    if (each.empty() || machine.exists(each)) continue;
    found.advise("environment", fmt::format("{} names {}, which is not there", variable, each),
                 "unset " + variable);
  }
}

}  // namespace

void check_packages(const Machine& machine, const std::string& list, Findings& found) {
  if (list.empty()) return found.good("packages", "VERP is installed with what it needs");
  if (machine.read("/etc/os-release").find("VERSION_CODENAME=bookworm") == std::string::npos) {
    found.advise("system", "this is not Debian 12; VERP is tested only there",
                 "docker run -it debian:12  # for example");
  }
  const std::set<std::string> installed = installed_packages(machine);
  if (installed.empty()) {
    return found.bad("packages", "/var/lib/dpkg/status lists no package",
                     "use Debian 12, or install what toolchains/packages.txt lists");
  }
  for (const auto& [stage, commands] : kStages) {
    const std::string missing = missing_of(stage, list, installed);
    const std::string check = fmt::format("packages {}", stage);
    const std::string text = fmt::format("missing for {}:{}", commands, missing);
    const std::string fix = "sudo apt-get install --no-install-recommends" + missing;
    if (missing.empty()) {
      found.good(check, fmt::format("all installed, for {}", commands));
    } else if (stage == std::string("run")) {
      found.bad(check, text, fix);
    } else {
      found.advise(check, text, fix);
    }
  }
}

void check_environment(const Machine& machine, Findings& found) {
  const std::size_t before = found.size();
  for (const auto& [name, effect] : kVariables) {
    const std::string value = machine.variable(name);
    if (value.empty()) continue;
    found.advise("environment", fmt::format("{}={} {}", name, value, effect),
                 fmt::format("unset {}", name));
  }
  check_folders(machine, "VERP_ROBOT_PATH", found);
  check_folders(machine, "VERP_MODEL_PATH", found);
  std::string cache = machine.variable("CCACHE_DIR");
  if (cache.empty()) cache = machine.variable("HOME") + "/.cache/ccache";
  if (machine.exists(cache) && !machine.may_use(cache)) {
    found.advise("ccache", cache + " cannot be written: each build compiles everything",
                 fmt::format("sudo chown -R {} {}", machine.user(), cache));
  }
  if (found.size() > before) return;
  found.good("environment", "no variable changes what is built or run");
}

void check_disk(const Machine& machine, Findings& found) {
  const std::string& folder = machine.current_folder;
  if (!machine.may_use(folder)) {
    return found.bad("folder", folder + " cannot be written; a walk leaves its files there",
                     "cd ~");
  }
  const auto free = machine.free_bytes(folder);
  if (!free) return found.good("disk", "its free space is not known");
  const std::uint64_t left_MB = *free / kMegabyte;
  const std::string text = fmt::format("{} MB are free in {}", left_MB, folder);
  const char* fix = "du -xh -d 1 ~ | sort -h | tail  # shows what is large";
  if (left_MB < kWalk_MB) return found.bad("disk", text + ": too few for a long walk", fix);
  if (left_MB < kBuild_MB) return found.advise("disk", text + ": too few for a build", fix);
  found.good("disk", text);
}

}  // namespace verp::tool
