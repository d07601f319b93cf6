#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/tool/robot/setup_command.hpp"
#include "host/apps/tool/robot/wire_picture.hpp"
#include "host/os/files/temporary_directory.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/find.hpp"
#include "host/run/scenario/expand.hpp"

namespace verp::tool {
namespace {

struct WireWords {
  std::string robot = "generic21", bus, show = "tick", picture;
  int tick = 400;
  bool json = false;
};

constexpr int kTicksOfPeriod = 3;
constexpr std::size_t kMostBytesShown = 14;

/// The part of a run that is shown.
struct WireView {
  std::vector<WirePacket> packets;
  std::vector<WireSpan> spans;
  double begin_us() const { return packets.front().begin_us; }
  double end_us() const {
    double end_us = 0;
    for (const WirePacket& each : packets) end_us = std::max(end_us, each.end_us);
    return end_us;
  }
};

using Packets = std::vector<WirePacket>;

Packets::const_iterator first_of(const Packets& all, int tick) {
  return std::find_if(all.begin(), all.end(),
                      [tick](const WirePacket& each) { return each.board && each.tick == tick; });
}

WireView view_of_ticks(const Packets& all, int first, int count) {
  WireView view;
  view.packets.assign(first_of(all, first), first_of(all, first + count));
  for (int tick = first; tick < first + count; ++tick) {
    const auto begin = first_of(all, tick), end = first_of(all, tick + 1);
    if (tick + 1 < first + count) {
      view.spans.push_back({begin->begin_us, end->begin_us, fmt::format("tick {}", tick)});
    }
  }
  if (count == 1) view.spans.push_back({view.begin_us(), view.end_us(), "one tick on the wire"});
  return view;
}

/// The first ping with its answer, or alone.
WireView view_of_ping(const Packets& all, bool alone) {
  WireView view;
  const auto ping = std::find_if(all.begin(), all.end(), [](const WirePacket& each) {
    return each.board && each.name.starts_with("ping");
  });
  view.packets.assign(ping, ping + (alone ? 1 : 2));
  if (alone) {
    view.spans = {{ping[0].begin_us, ping[0].end_us, ping[0].name}};
  } else {
    view.spans = {{ping[0].end_us, ping[1].begin_us, "return delay"}};
  }
  return view;
}

WireView view_of(const WireWords& words, const session::WalkPlan& plan) {
  const bool silent = words.show == "silent";
  const int ticks = words.show == "period" ? kTicksOfPeriod : words.show == "tick" ? 1 : 0;
  const int end = ticks > 0 ? words.tick + ticks : 0;
  const Packets all = log_wire(plan, end, silent);
  if (ticks > 0 && (first_of(all, words.tick) == all.end() || first_of(all, end) == all.end())) {
    throw cli::ToolError(cli::kRunFailed,
                         fmt::format("verp bus wire: the twin fell or stopped before tick {}; "
                                     "give an earlier one with --tick",
                                     end));
  }
  if (ticks > 0) return view_of_ticks(all, words.tick, ticks);
  if (!silent) return view_of_ping(all, words.show == "bits");
  WireView view{all, {}};
  view.spans = {{view.begin_us(), view.end_us(), "a bring-up that nobody answers"}};
  return view;
}

std::string title_of(const WireWords& words, const Params& params) {
  const char* bus = params.bus_protocol == BusProtocol::kCia402    ? "CAN"
                    : params.bus_protocol == BusProtocol::kFeetech ? "a Feetech bus"
                                                                   : "a Dynamixel bus";
  const std::string what = words.show == "ping"     ? "first ping"
                           : words.show == "bits"   ? "first ping, bit by bit"
                           : words.show == "silent" ? "no servo"
                           : words.show == "tick"   ? fmt::format("tick {}", words.tick)
                                                    : fmt::format("ticks from {}", words.tick);
  return fmt::format("{} on {} at {} bit/s, {}", params.name, bus, params.baud, what);
}

std::string hex(const WirePacket& packet) {
  std::string text;
  const std::size_t count = std::min(packet.bytes.size(), kMostBytesShown);
  for (std::size_t i = 0; i < count; ++i) text += fmt::format(" {:02X}", packet.bytes[i]);
  return count < packet.bytes.size() ? text + " ..." : text;
}

std::string table_of(const std::string& title, const WireView& view) {
  std::string text = title + '\n';
  for (const WireSpan& each : view.spans) {
    text += fmt::format("{}: {:.1f} us\n", each.what, each.end_us - each.begin_us);
  }
  text += fmt::format("{:>9} {:>9} {:<7} {:<20} {:>5}\n", "us", "to us", "sender", "what", "bytes");
  for (const WirePacket& each : view.packets) {
    text += fmt::format("{:9.1f} {:9.1f} {:<7} {:<20} {:>5} {}\n", each.begin_us - view.begin_us(),
                        each.end_us - view.begin_us(), each.board ? "board" : "device", each.name,
                        each.bytes.size(), hex(each));
  }
  return text;
}

cli::Json json_of(const WireWords& words, const Params& params, const WireView& view) {
  cli::Json json = {{"robot", params.name},
                    {"show", words.show},
                    {"baud", params.baud},
                    {"period_us", params.period_us},
                    {"wire_us", view.end_us() - view.begin_us()},
                    {"times", cli::Json::array()},
                    {"packets", cli::Json::array()}};
  for (const WireSpan& each : view.spans) {
    json["times"].push_back({{"what", each.what}, {"us", each.end_us - each.begin_us}});
  }
  for (const WirePacket& each : view.packets) {
    json["packets"].push_back({{"begin_us", each.begin_us - view.begin_us()},
                               {"end_us", each.end_us - view.begin_us()},
                               {"sender", each.board ? "board" : "device"},
                               {"what", each.name},
                               {"bytes", each.bytes}});
  }
  return json;
}

int show_wire(const WireWords& words) {
  scenario::Robot robot;
  robot.model = words.robot;
  robot.bus = words.bus;
  const session::WalkPlan plan = scenario::plan_of(robot, 1 + 0.02 * words.tick);
  const bool can = plan.params.bus_protocol == BusProtocol::kCia402;
  // CAN's bring-up has no ping, and other answers than a servo bus.
  if (can && (words.show != "tick" && words.show != "period")) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("--show {}: of a CAN bus there is tick and period", words.show));
  }
  const WireView view = view_of(words, plan);
  const std::string title = title_of(words, plan.params);
  if (!words.picture.empty()) {
    const files::Trouble trouble =
        files::replace(words.picture, draw_wire(title, view.packets, view.spans, can));
    if (trouble.any()) throw files::FileError(words.picture + ": " + trouble.text());
  }
  cli::print_answer(words.json, json_of(words, plan.params, view), table_of(title, view));
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_bus_wire(CLI::App& bus) {
  CLI::App* app = bus.add_subcommand(
      "wire", "what a logic analyser shows on the bus: the bytes of the twin, and their times");
  auto words = std::make_shared<WireWords>();
  cli::add_model(*app, words->robot)->capture_default_str();
  cli::add_bus_option(*app, words->bus);
  app->add_option(
         "--show", words->show,
         "tick; period: three ticks; ping: the first; bits: of it; silent: a start without "
         "servos")
      ->check(CLI::IsMember({"tick", "period", "ping", "bits", "silent"}))
      ->capture_default_str();
  app->add_option("--tick", words->tick, "which tick is the first")
      ->transform(cli::whole_number_between(1, 100'000))
      ->capture_default_str();
  app->add_option("--picture", words->picture, "also draws it, as SVG");
  cli::add_json_flag(*app, words->json);
  return {app, [words] { return show_wire(*words); }};
}

}  // namespace verp::tool
