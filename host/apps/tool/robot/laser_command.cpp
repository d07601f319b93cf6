#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/tool/robot/setup_command.hpp"
#include "host/os/link/link.hpp"
#include "host/os/link/scip_range_finder.hpp"
#include "host/os/link/system_clock.hpp"

namespace verp::tool {
namespace {

struct LaserWords {
  std::string link;
  int first = 44, last = 725, least_mm = 20;
  double seconds = 2;
  bool json = false;
};

struct Nearest {
  std::uint16_t range_mm = 0;  ///< 0: nothing in range
  std::size_t step = 0, seen = 0;
};

Nearest nearest(const hal::RangeScan& scan) {
  Nearest found;
  for (std::size_t i = 0; i < scan.steps; ++i) {
    const std::uint16_t range_mm = scan.range_mm[i];
    if (range_mm == 0) continue;
    ++found.seen;
    if (found.range_mm == 0 || range_mm < found.range_mm) found = {range_mm, i, found.seen};
  }
  return found;
}

std::string in_words(const hal::RangeScan& scan, int first) {
  const Nearest found = nearest(scan);
  return fmt::format(
      "{:9.3f} s  {} of {} steps see something{}\n", 1e-6 * static_cast<double>(scan.time_us),
      found.seen, scan.steps,
      found.seen == 0 ? ""
                      : fmt::format(", the nearest {:.3f} m away at step {}", 1e-3 * found.range_mm,
                                    static_cast<std::size_t>(first) + found.step));
}

template <hal::RangeFinder Finder>
std::size_t watch(Finder& finder, const LaserWords& words, cli::Json& scans) {
  hal::RangeScan scan;
  std::size_t count = 0;
  const std::uint64_t end_ns =
      link::monotonic_ns() + static_cast<std::uint64_t>(1e9 * words.seconds);
  while (link::monotonic_ns() < end_ns && !cli::interrupted()) {
    if (finder.read(scan) != hal::RangeStatus::kFresh) {
      link::sleep_until_ns(link::monotonic_ns() + 1'000'000);
      continue;
    }
    ++count;
    if (!words.json) cli::answer(in_words(scan, words.first));
    if (!words.json) continue;
    scans.push_back(
        {{"time_s", 1e-6 * static_cast<double>(scan.time_us)},
         {"range_mm", std::vector<std::uint16_t>(scan.range_mm, scan.range_mm + scan.steps)}});
  }
  return count;
}

int run_laser(const LaserWords& words) {
  if (words.last < words.first || words.last - words.first >= int{hal::kMostRangeSteps}) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("verp bus laser: --first {} --last {}: give the steps from right "
                    "to left, {} at most",
                    words.first, words.last, hal::kMostRangeSteps));
  }
  link::Link link(link::parse_endpoint(words.link));
  link::ScipRangeFinder<link::Link> finder(
      link, {.first = words.first,
             .last = words.last,
             .least_mm = static_cast<std::uint16_t>(words.least_mm)});
  cli::Json scans = cli::Json::array();
  const std::size_t count = watch(finder, words, scans);
  finder.stop();
  if (count > 0) {
    if (words.json) cli::print_json({{"scans", scans}, {"damaged", finder.damaged()}});
    return cli::kGood;
  }
  throw cli::ToolError(
      cli::kNoDevice,
      fmt::format(
          "verp bus laser: {}: no scan in {:g} s{}; look at cable, power and baud rate, "
          "and whether it speaks SCIP 2.0",
          words.link, words.seconds,
          finder.last_complaint().empty() ? "" : " (it says " + finder.last_complaint() + ")"));
}

}  // namespace

cli::Subcommand add_bus_laser(CLI::App& bus) {
  CLI::App* app =
      bus.add_subcommand("laser", "what a laser range finder measures (Hokuyo, SCIP 2.0)");
  auto words = std::make_shared<LaserWords>();
  app->add_option("--link", words->link, "serial:DEVICE@BAUD, such as serial:/dev/ttyACM0@115200")
      ->required();
  app->add_option("--first", words->first, "the rightmost step")
      ->check(CLI::Range(0, 9999))
      ->capture_default_str();
  app->add_option("--last", words->last, "the leftmost one")
      ->check(CLI::Range(0, 9999))
      ->capture_default_str();
  app->add_option("--least-mm", words->least_mm, "shorter ones are errors (DMIN)")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  app->add_option("--for", words->seconds, "how long, s")
      ->transform(cli::number_between(0.1, 3600, "s"))
      ->capture_default_str();
  cli::add_json_flag(*app, words->json);
  return {app, [words] {
            cli::catch_interrupts();
            return run_laser(*words);
          }};
}

}  // namespace verp::tool
