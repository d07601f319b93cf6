#include <fmt/format.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/apps/libverp/verp.hpp"
#include "host/boards/board/temporary_directory.hpp"
#include "host/os/files/places.hpp"
#include "host/os/files/whole.hpp"
#include "host/os/link/link.hpp"
#include "host/os/process/child.hpp"
#include "host/twin/bus/lockstep_server.hpp"
#include "host/twin/bus/virtual_bus.hpp"
#include "tests/hil/level_plant.hpp"
#include "tests/support/link_pump.hpp"
#include "tests/target/twin_run.hpp"

/// language_bench TIMES: control ticks per second from each language, without physics. One JSON
/// line each; a missing language is no failure.
namespace {

using Json = nlohmann::json;
using Rates = std::vector<double>;

struct Missing : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

bool succeeds(const std::string& command) {
  return std::system((command + " </dev/null >/dev/null 2>&1").c_str()) == 0;
}

std::string last_words(const std::filesystem::path& file) {
  return verp::process::last_line(verp::files::read(file).value_or(""));
}

/// One number per line.
Rates rates_of(const std::string& command) {
  const verp::board::TemporaryDirectory scratch;
  const std::string errors = (scratch.path() / "errors").string();
  FILE* pipe = popen((command + " </dev/null 2>" + quoted(errors)).c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("no shell");
  std::string text;
  for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  const int status = pclose(pipe);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error(last_words(errors));
  Rates rates;
  std::istringstream in(text);
  for (double rate; in >> rate;) rates.push_back(rate);
  if (rates.empty()) throw std::runtime_error("it printed no number: " + text);
  return rates;
}

std::string library() {
  return (verp::files::build_dir() / "host/apps/libverp/libverp.so.0").string();
}

void need_library() {
#ifdef VERP_BENCH_SANITIZED
  throw Missing("this build's library has sanitizers, which no other program can load");
#endif
}

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Rates in_cpp(int times) {
  std::vector<verp_inputs> saw;
  verp_lib::Session session;
  verp_robot robot = verp_lib::Session::defaults();
  robot.walk_s = 3;
  session.add(robot);
  while (session.tick()) saw.push_back(session.seen().inputs);
  verp_lib::Core core;
  Rates rates;
  for (int n = 0; n < times; ++n) {
    core.reset();
    verp_outputs outputs;
    const double start_s = cpu_s();
    for (const verp_inputs& inputs : saw) core.step(inputs, outputs);
    rates.push_back(static_cast<double>(saw.size()) / (cpu_s() - start_s));
    if (core.digest() != session.digest()) {
      throw std::runtime_error("the controller did not decide what it did in the walk");
    }
  }
  return rates;
}

Rates in_python(int times) {
  need_library();
  // Another Python lacks Debian's packages.
  if (!succeeds("/usr/bin/python3 -c 'import cffi, numpy'")) {
    throw Missing("apt-get install python3-cffi python3-numpy");
  }
  return rates_of(fmt::format(
      "PYTHONDONTWRITEBYTECODE=1 PYTHONPATH={} VERP_LIBRARY={} /usr/bin/python3 {} {}",
      quoted((verp::files::source_dir() / "host/apps/libverp/python").string()), quoted(library()),
      quoted((verp::files::source_dir() / "tests/bench/languages/rate.py").string()), times));
}

Rates in_octave(int times) {
  need_library();
  const auto source = verp::files::source_dir();
  const auto mex = verp::files::build_dir() / "host/apps/libverp/octave";
  if (!succeeds("octave-cli --version") || !std::filesystem::exists(mex / "verp_mex.mex")) {
    throw Missing("apt-get install octave octave-dev");
  }
  return rates_of(fmt::format(
      R"(octave-cli --norc --no-history -q --path {} --path {} --path {} --eval 'fprintf("%.0f\n", verp_rate({}))')",
      quoted((source / "host/apps/libverp/matlab").string()),
      quoted((source / "tests/bench/languages").string()), quoted(mex.string()), times));
}

Rates in_csharp(int times) {
  need_library();
  const auto program = verp::files::build_dir() / "bench/rate.exe";
  if (!succeeds("mono --version") || !std::filesystem::exists(program)) {
    throw Missing("apt-get install mono-mcs mono-runtime");
  }
  const auto folder = verp::files::build_dir() / "host/apps/libverp";
  return rates_of(fmt::format("LD_LIBRARY_PATH={} MONO_PATH={} mono {} {}", quoted(folder.string()),
                              quoted((folder / "csharp").string()), quoted(program.string()),
                              times));
}

/// `verp run` in lockstep over a Unix socket; wall-clock time, because two processes take turns.
double external_rate() {
  using Clock = std::chrono::steady_clock;
  constexpr auto kPatience = std::chrono::seconds(30);
  const verp::board::TemporaryDirectory folder;
  const std::string socket = (folder.path() / "bus").string();
  const verp::test::Robot robot = verp::test::load_robot("generic21");
  verp::test::LevelPlant plant(robot.params);
  verp::bus::VirtualBus bus(robot.params, plant);
  Clock::time_point first, last;
  int ticks = 0;
  verp::bus::LockstepHooks hooks;
  hooks.tick_begins = [&](std::uint32_t) {
    last = Clock::now();
    if (ticks++ == 0) first = last;
  };
  verp::bus::LockstepServer server(robot.params, bus, hooks);
  verp::link::Link link(verp::link::parse_endpoint("unix-listen:" + socket));
  verp::bus::LinkPump pump(link, server);
  const std::string errors = (folder.path() / "errors").string();
  verp::process::Child controller(
      {.words = {(verp::files::build_dir() / "host/apps/tool/verp").string(), "run", "generic21",
                 "--lockstep", "--for", "5", "--yes", "--link", "unix:" + socket},
       .input = {},
       .output = {},
       .error = verp::process::Stream{.file = errors}});
  Clock::time_point heard = Clock::now();
  while (!controller.status()) {
    if (pump.turn(10'000)) heard = Clock::now();
    if (Clock::now() - heard > kPatience) throw std::runtime_error("verp run fell silent");
  }
  if (*controller.status() != 0) throw std::runtime_error(last_words(errors));
  if (ticks < 2) throw std::runtime_error("verp run had no tick");
  return (ticks - 1) / std::chrono::duration<double>(last - first).count();
}

Rates in_external(int times) {
  Rates rates;
  for (int n = 0; n < times; ++n) rates.push_back(external_rate());
  return rates;
}

int run(int times) {
  constexpr struct {
    const char* name;
    Rates (*measure)(int);
  } kAll[] = {{"cpp", in_cpp},
              {"csharp", in_csharp},
              {"python", in_python},
              {"octave", in_octave},
              {"external", in_external}};
  for (const auto& each : kAll) {
    Json line = {{"language", each.name}};
    try {
      line["ticks_per_s"] = each.measure(times);
    } catch (const Missing& missing) {
      line["missing"] = missing.what();
    } catch (const std::exception& failed) {
      line["failed"] = failed.what();
    }
    fmt::print("{}\n", line.dump());
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int times = argc == 2 ? std::atoi(argv[1]) : 0;
  if (times > 0) return run(times);
  fmt::print(stderr, "language_bench: usage: language_bench TIMES\n");
  return 2;
}
