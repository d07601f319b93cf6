#include "host/apps/tool/team_options.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

#include "host/apps/cli/command.hpp"
#include "host/apps/tool/radio_words.hpp"
#include "host/run/scenario/text.hpp"

namespace verp::tool {
namespace {

constexpr double kMostPatience_s = 3600;

/// `text` without `prefix`; empty if it does not begin so.
std::string behind(const std::string& prefix, const std::string& text) {
  return text.compare(0, prefix.size(), prefix) == 0 ? text.substr(prefix.size()) : "";
}

/// False: `text` names no controller.
bool take_driver(const std::string& text, Seat& seat) {
  seat.link = behind("ext:", text);
  seat.board = behind("on:", text);
  return !seat.link.empty() || !seat.board.empty();
}

void require_one_driver(const std::string& command, const std::string& word, const Seat& seat) {
  const bool boards = seat.board.find(',') != std::string::npos;
  const bool links =
      seat.link.find(",on:") != std::string::npos || seat.link.find(",ext:") != std::string::npos;
  if (!boards && !links) return;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("{}: --robot {}: a robot has one controller: on:BOARD or "
                                   "ext:LINK, and a model stands before it",
                                   command, word));
}

Seat parse_seat(const std::string& command, const std::string& word) {
  const std::size_t equals = word.find('=');
  Seat seat{.name = word.substr(0, equals), .model = {}, .link = {}, .board = {}};
  const std::string what = word.substr(equals + 1);
  if (take_driver(what, seat)) {
    require_one_driver(command, word, seat);
    return seat;
  }
  const std::size_t comma = what.find(',');
  seat.model = what.substr(0, comma);
  const bool whole = comma == std::string::npos || take_driver(what.substr(comma + 1), seat);
  require_one_driver(command, word, seat);
  if (whole && !seat.model.empty() && seat.model != "ext:" && seat.model != "on:") return seat;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("{}: --robot {}: that is not NAME=MODEL, NAME=ext:LINK, "
                                   "NAME=on:BOARD, or NAME=MODEL,ext:LINK",
                                   command, word));
}

}  // namespace

void declare_robots(CLI::App& app, TeamOptions& options) {
  app.add_option("--robots", options.robots,
                 "so many robots in one world, two abreast; their names are r1, r2, ...")
      ->check(cli::whole_number_between(1, scenario::kMostRobots));
}

void declare_outside(CLI::App& app, TeamOptions& options) {
  app.add_flag_callback(
      "--if-lost-go-on",
      [&options] {
        options.go_on = true;
        options.of_outside = "--if-lost-go-on";
      },
      "a robot that lost its controller (--robot NAME=ext:LINK) ends no others");
  app.add_option(
         "--patience", options.patience_s,
         "how long such a controller may keep the world waiting once it has come, s by the wall's "
         "clock; for the first words of one it waits as long as it takes")
      ->check(cli::number_between(0.1, kMostPatience_s, "s"))
      ->each([&options](const std::string&) { options.of_outside = "--patience"; })
      ->capture_default_str();
}

void declare_radio(CLI::App& app, std::optional<std::string>& radio) {
  app.add_option_function<std::string>(
         "--radio", [&radio](const std::string& words) { radio = words; },
         std::string("the robots have radios, those driven from outside as a modem on "
                     "their bus (host/twin/radio); ") +
             kRadioWords)
      ->expected(0, 1)
      ->type_name("TEXT");
}

bool sort_robot_words(const std::vector<std::string>& words, std::string& model,
                      std::vector<std::string>& seats) {
  bool given = false;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals != std::string::npos && scenario::is_name(word.substr(0, equals))) {
      seats.push_back(word);
      continue;
    }
    if (given) {
      throw cli::ToolError(
          cli::kBadInput,
          fmt::format("verp walk: two models, {} and {}; several robots have names: "
                      "--robot a={} --robot b={}",
                      model, word, model, word));
    }
    model = word;
    given = true;
  }
  return given;
}

std::vector<Seat> seats_of(const std::string& command, const TeamOptions& options) {
  std::vector<Seat> seats;
  for (int i = 0; i < options.robots; ++i)
    seats.push_back({.name = fmt::format("r{}", i + 1), .model = {}, .link = {}, .board = {}});
  std::vector<std::string> named;
  for (const std::string& word : options.seats) {
    const Seat seat = parse_seat(command, word);
    if (std::count(named.begin(), named.end(), seat.name) > 0) {
      throw cli::ToolError(cli::kBadInput,
                           fmt::format("{}: --robot {}: there is a robot {} already; give "
                                       "each a name of its own",
                                       command, word, seat.name));
    }
    named.push_back(seat.name);
    const auto same = std::find_if(seats.begin(), seats.end(),
                                   [&](const Seat& each) { return each.name == seat.name; });
    same == seats.end() ? seats.push_back(seat) : void(*same = seat);
  }
  if (seats.size() > scenario::kMostRobots) {
    throw cli::ToolError(cli::kBadInput, fmt::format("{}: {} robots; a world has room for {}",
                                                     command, seats.size(), scenario::kMostRobots));
  }
  return seats;
}

sim::Vec2 place_in_column(std::size_t index) {
  constexpr double kApart_m = 0.8;
  const auto row = static_cast<double>(index / 2);
  return {-kApart_m * row, index % 2 == 0 ? 0.0 : -kApart_m};
}

}  // namespace verp::tool
