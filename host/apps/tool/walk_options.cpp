#include "host/apps/tool/walk_options.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/model/tuning_ranges.hpp"
#include "host/apps/cli/command.hpp"
#include "host/apps/cli/suggest.hpp"
#include "host/apps/tool/own_controller.hpp"
#include "host/os/link/endpoint.hpp"
#include "host/robot/model/params.hpp"

namespace verp::tool {
namespace {

constexpr double kMaxStep_m = 0.15;    // longer than legs can swing
constexpr double kMaxWalk_s = 86400;   // a day
constexpr double kMaxSpeed_m_s = 2.0;  // within 16 bits of 0.1 mm/s
constexpr double kMaxTurn_rad_s = 6.3;
constexpr std::size_t kMaxSweep = 50;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

double number(const std::string& command, const std::string& option, const std::string& text,
              double low, double high, const std::string& unit) {
  try {
    return cli::parse_number(text, low, high, unit);
  } catch (const CLI::ValidationError& error) {
    throw cli::ToolError(cli::kBadInput, fmt::format("{}: {}: {}", command, option, error.what()));
  }
}

/// The decimal number behind a float: 0.06 for 0.06F.
double decimal(float value) {
  return std::stod(fmt::format("{:g}", value));
}

void set_by_name(std::map<std::string, double>& tuning, const std::string& setting,
                 const std::string& command) {
  const std::size_t equals = setting.find('=');
  const std::string name = setting.substr(0, equals);
  const auto id = model::tuning_id(name);
  if (!id) {
    const std::string meant = cli::did_you_mean(name, model::tuning_names());
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: --set {}: no such parameter{}", command, setting,
                                     meant.empty() ? "; `verp parameters` lists them" : meant));
  }
  if (equals == std::string::npos) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: --set {}: no value; give NAME=VALUE", command, setting));
  }
  if (name == "gait.cycle_s") {
    throw cli::ToolError(
        cli::kBadInput,
        command + ": --set gait.cycle_s: give --cycle, which --step is measured by");
  }
  // Ranges are float32: one that ends at 0.03F includes 0.03.
  const Range& range = kTuningRanges[*id];
  tuning[name] = number(command, "--set " + name, setting.substr(equals + 1), decimal(range.low),
                        decimal(range.high), "");
}

}  // namespace

void declare_gait(CLI::App& app, WalkOptions& options) {
  cli::add_model(app, options.model)->capture_default_str();
  cli::add_bus_option(app, options.bus);
  app.add_option("--step", options.step_m, "step length, m; at its default at most gait.max_step_m")
      ->check(cli::number_between(0, kMaxStep_m, "m"))
      ->capture_default_str();
  app.add_option("--velocity", options.velocity_text, "VX,VY,WZ in m/s and rad/s instead of --step")
      ->excludes("--step");
  app.add_flag("--stand", options.stand,
               "stand instead, for as long; pushed further than ankles answer to, it steps")
      ->excludes("--step")
      ->excludes("--velocity");
  app.add_option(
         "--for", options.walk_s,
         "length of the gait, all three phases, s; it ends with the last whole step that fits")
      ->check(cli::number_between(3, kMaxWalk_s, "s"))
      ->capture_default_str();
}

void declare_tuning(CLI::App& app, WalkOptions& options) {
  app.add_option("--cycle", options.cycle_s,
                 "two steps, s; default: the robot's gait.cycle_s, 0.45")
      ->check(cli::number_between(0.3, 2.0, "s"));
  app.add_option("--set", options.settings, "NAME=VALUE: a gait, balance or safety parameter");
}

void declare_basics(CLI::App& app, WalkOptions& options) {
  declare_gait(app, options);
  app.add_option("--seed", options.seed, "of every random thing in the twin")
      ->check(cli::whole_number_between(0, scenario::kMostSeed))
      ->capture_default_str();
  app.add_option("--record", options.record_file, "write the trace here (.mcap)");
  app.add_option("--report", options.report_folder, "write the report here (default: report)");
  app.add_flag("--record-state", options.record_state,
               "keep the full State of every tick in the trace");
  app.add_flag("--compress", options.compress, kCompress);
  cli::add_json_flag(app, options.json);
}

void declare_twin(CLI::App& app, WalkOptions& options) {
  app.add_option("--physics-step", options.physics_step_ms,
                 "of the twin, ms: 0.25, 0.5, 1, or 2, which is twice as fast and within 1 %")
      ->check(CLI::IsMember({0.25, 0.5, 1.0, 2.0}))
      ->capture_default_str();
  app.add_flag(
      "--get-up", options.get_up,
      "falls end no walk: it falls softly, gets up by its actions fall_safe and get_up_..., "
      "and walks on");
  app.add_option("--fault", options.fault,
                 "inject a field bug: a mistake that builders of robots reported; `verp faults` "
                 "lists them");
  app.add_option("--start", options.start,
                 "standing; or lying:SIDE on the floor: front, back, left, right is down; any: a "
                 "pose drawn from the seed. It gets up first")
      ->check(CLI::IsMember(
          {"standing", "lying:front", "lying:back", "lying:left", "lying:right", "lying:any"}))
      ->capture_default_str();
}

namespace {

/// These options change no bit of a run.
const std::set<std::string> kOfNoEffect = {
    "--json",    "--report",    "--record", "--record-state", "--compress",
    "--cameras", "--real-time", "--live",   "--live-wait",    "--live-origin"};

/// Options that --scenario allows, because they do not describe the run.
const std::set<std::string> kBesideScenario = {"--scenario", "--print-scenario",
                                               "--list-quantities", "--link", "--gamepad"};

}  // namespace

std::vector<std::string> typed_options(const CLI::App& app) {
  std::vector<std::string> typed;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() > 0 && !option->get_positional() &&
        !kOfNoEffect.contains(option->get_name())) {
      typed.push_back(option->get_name());
    }
  }
  return typed;
}

std::vector<std::pair<std::string, std::string>> changed_options(const CLI::App& app) {
  std::vector<std::pair<std::string, std::string>> changed;
  for (const std::string& name : typed_options(app)) {
    const CLI::Option* option = app.get_option(name);
    for (const std::string& value : option->results()) {
      if (value == option->get_default_str()) continue;
      const bool flag = option->get_items_expected_max() == 0;
      changed.emplace_back(option->get_name(), flag ? "" : value);
    }
  }
  return changed;
}

bool WalkOptions::changes(const std::string& option) const {
  return std::any_of(changed.begin(), changed.end(),
                     [&](const auto& each) { return each.first == option; });
}

void declare(CLI::App& app, WalkOptions& options) {
  declare_basics(app, options);
  app.remove_option(app.get_option("MODEL"));
  app.add_option("MODEL,--robot", options.robot_words,
                 "a robot by its name, or the path of its SDF file. Several: --robot "
                 "NAME=MODEL[,ext:LINK|,on:BOARD] for each, driven by this program, by another one "
                 "at the end of a link (in lockstep), or on an emulated board")
      ->type_name("TEXT=generic21")
      ->allow_extra_args(false);
  declare_robots(app, options.team);
  declare_outside(app, options.team);
  declare_radio(app, options.radio);
  declare_tuning(app, options);
  app.add_option("--sweep-step", options.sweep_text,
                 "FROM:TO:BY in m: also walk at each step length, with and without the multibody "
                 "correction")
      ->excludes("--velocity")
      ->excludes("--stand");
  app.add_flag(
      "--vary", options.vary,
      "another robot of this kind, drawn from the seed: masses, friction, delay, backlash, "
      "strength, gears, gyro bias, floor, supply; the controller does not know");
  declare_twin(app, options);
  app.add_option("--seeds", options.seeds_text,
                 "A-B: one walk for each of these seeds, as many at a time as there are cores; "
                 "1-100 are for gates, 1001 and up for tuning, 2001 and up for reports")
      ->excludes("--sweep-step")
      ->excludes("--seed")
      ->excludes("--record")
      ->excludes("--report");
  app.add_flag("--cameras", options.cameras,
               "keep what the robot's cameras see in the trace; `verp trace pictures` takes it out")
      ->excludes("--seeds");
  app.add_flag("--real-time", options.real_time,
               "walk no faster than time goes by, and say which ticks were late")
      ->excludes("--seeds");
  declare(app, options.place);
  declare(app, options.touch);
  app.add_option("--on", options.board,
                 "run the controller in firmware on this emulated board (boards/)");
  declare_controller(app, options.controller);
  app.add_flag("--no-multibody", options.no_multibody, "switch the multibody ZMP correction off");
  app.add_flag("--no-feedback", options.no_feedback, "switch gyro and tilt feedback off");
  app.add_flag("--no-gravity", options.no_gravity, "switch the gravity feed-forward off");
  app.add_flag("--no-zeros", options.no_zeros,
               "leave out what was learnt of the legs: zero errors and landings");
  declare(app, options.map);
  declare_live(app, options.live);
  for (const char* many : {"--seeds", "--map"}) app.get_option("--live")->excludes(many);
  app.add_flag("--print-scenario", options.print_scenario,
               "print the run as a scenario file, and do not run it");
  app.add_option(
      "--scenario", options.scenario_file,
      "the run that this file describes (JSON; --print-scenario prints one), in place of "
      "the options that do");
}

void refuse_beside_scenario(const WalkOptions& options) {
  const auto refuse = [&](const std::string& name) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("{}: {} says how the run is, and so does --scenario {}; leave one out",
                    options.command, name, options.scenario_file));
  };
  if (options.scenario_file.empty()) return;
  if (options.model_given) refuse(options.model);
  for (const std::string& name : options.typed) {
    if (!kBesideScenario.contains(name)) refuse(name);
  }
}

void require_fit(const std::string& command, const std::string& link, const Params& params) {
  const bool can_link = link::parse_endpoint(link).kind == link::Endpoint::Kind::kCan;
  if (can_link == (params.bus_protocol == BusProtocol::kCia402)) return;
  throw cli::ToolError(
      cli::kBadInput, fmt::format("{}: {} is {} CAN interface, and the chosen bus of {} speaks {}; "
                                  "choose another of its buses with --bus",
                                  command, link, can_link ? "a" : "no", params.name,
                                  model::protocol_name(params.bus_protocol)));
}

scenario::Orders orders_of(const WalkOptions& options) {
  if (options.stand) return scenario::Stand{};
  if (options.velocity_text.empty()) return scenario::Ahead{options.step_m};
  const std::vector<std::string> parts = split(options.velocity_text, ',');
  if (parts.size() != 3) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: --velocity '{}' is not VX,VY,WZ; example: 0.1,0,0.2",
                                     options.command, options.velocity_text));
  }
  const auto part = [&](std::size_t i, const char* name, double most, const char* unit) {
    return number(options.command, name, parts[i], -most, most, unit);
  };
  return scenario::Velocity{part(0, "--velocity VX", kMaxSpeed_m_s, "m/s"),
                            part(1, "--velocity VY", kMaxSpeed_m_s, "m/s"),
                            part(2, "--velocity WZ", kMaxTurn_rad_s, "rad/s")};
}

void read_robot_words(WalkOptions& options) {
  options.model_given = sort_robot_words(options.robot_words, options.model, options.team.seats);
  for (const std::string& seat : options.team.seats) options.changed.emplace_back("--robot", seat);
}

std::pair<std::uint64_t, std::uint64_t> seeds_of(const WalkOptions& options) {
  const std::vector<std::string> parts = split(options.seeds_text, '-');
  const std::string& command = options.command;
  if (parts.size() != 2) {
    throw cli::ToolError(cli::kBadInput, fmt::format("{}: --seeds '{}' is not A-B; example: 1-20",
                                                     command, options.seeds_text));
  }
  const double first = number(command, "--seeds A", parts[0], 0, scenario::kMostSeed, "");
  const double last = number(command, "--seeds B", parts[1], 0, scenario::kMostSeed, "");
  if (last < first) {
    throw cli::ToolError(
        cli::kBadInput, fmt::format("{}: --seeds '{}' goes down; the smaller one is first", command,
                                    options.seeds_text));
  }
  if (first != std::floor(first) || last != std::floor(last)) {
    throw cli::ToolError(cli::kBadInput, fmt::format("{}: --seeds '{}': seeds are whole numbers",
                                                     command, options.seeds_text));
  }
  return {static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(last)};
}

std::vector<double> sweep_of(const WalkOptions& options) {
  if (options.sweep_text.empty()) return {};
  const std::vector<std::string> parts = split(options.sweep_text, ':');
  if (parts.size() != 3) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("verp walk: --sweep-step '{}' is not FROM:TO:BY; example: 0.02:0.06:0.01",
                    options.sweep_text));
  }
  const double from_m = number("verp walk", "--sweep-step FROM", parts[0], 0, kMaxStep_m, "m");
  const double to_m = number("verp walk", "--sweep-step TO", parts[1], from_m, kMaxStep_m, "m");
  const double by_m = number("verp walk", "--sweep-step BY", parts[2], 0.001, kMaxStep_m, "m");
  std::vector<double> steps;
  for (std::size_t i = 0; i < kMaxSweep; ++i) {
    const double step_m = from_m + static_cast<double>(i) * by_m;
    if (step_m > to_m + 1e-9) return steps;
    steps.push_back(step_m);
  }
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp walk: --sweep-step '{}' is more than {} steps; raise BY",
                                   options.sweep_text, kMaxSweep));
}

std::map<std::string, double> tuning_of(const WalkOptions& options) {
  std::map<std::string, double> tuning;
  if (options.cycle_s > 0) tuning["gait.cycle_s"] = options.cycle_s;
  for (const std::string& setting : options.settings) set_by_name(tuning, setting, options.command);
  if (options.no_multibody) tuning["balance.multibody_enable"] = 0;
  if (options.no_feedback) tuning["balance.feedback_enable"] = 0;
  if (options.no_gravity) tuning["balance.gravity_enable"] = 0;
  if (options.no_zeros) tuning["balance.zeros_enable"] = 0;
  return tuning;
}

}  // namespace verp::tool
