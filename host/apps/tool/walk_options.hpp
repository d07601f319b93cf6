#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/model/params.hpp"
#include "host/apps/tool/live_stream.hpp"
#include "host/apps/tool/team_options.hpp"
#include "host/apps/tool/walk_map.hpp"
#include "host/apps/tool/walk_place.hpp"
#include "host/apps/tool/walk_touch.hpp"
#include "host/robot/model/entity.hpp"
#include "host/run/scenario/scenario.hpp"

namespace CLI {
class App;
}

namespace verp::tool {

inline constexpr const char* kCompress =
    "compress the trace's chunks by zstd: about a fifth of the bytes";

/// The checked command line of `verp walk`.
struct WalkOptions {
  std::string model = "generic21";
  std::string bus;  ///< empty: the model's first
  double step_m = 0.04;
  double cycle_s = 0;  ///< 0: the robot's cycle
  double walk_s = 20;
  std::uint64_t seed = 1;
  std::string velocity_text, sweep_text, record_file, report_folder, board;
  std::string controller;             ///< folder (verp new controller); empty: core
  std::vector<std::string> settings;  ///< NAME=VALUE
  std::string command = "verp walk";  ///< for messages
  bool no_multibody = false, no_feedback = false, no_gravity = false, no_zeros = false;
  bool record_state = false, compress = false, json = false;
  bool stand = false;              ///< stands instead of walking
  bool get_up = false;             ///< a fall does not end the walk
  std::string start = "standing";  ///< or lying:SIDE
  std::string fault;               ///< a field bug (verp faults)
  bool vary = false;               ///< domain randomization (host/twin/sim/vary.hpp)
  std::vector<std::pair<std::string, std::string>> changed;  ///< changed_options()
  std::vector<std::string> typed;                            ///< typed_options()
  std::string seeds_text;                                    ///< A-B: one walk each
  double physics_step_ms = 1;                                ///< 2 halves the wall time
  TouchOptions touch;
  PlaceOptions place;
  MapOptions map;
  TeamOptions team;
  std::string scenario_file;  ///< replaces options that describe a run
  bool print_scenario = false;
  std::optional<std::string> radio;      ///< its numbers; none: no radio
  std::vector<std::string> robot_words;  ///< MODEL and --robot
  bool model_given = false;
  LiveOptions live;
  bool cameras = false;
  bool real_time = false;

  /// The option differs from its default.
  bool changes(const std::string& option) const;
};

void declare(CLI::App& app, WalkOptions& options);

/// Options that change the run, with values.
std::vector<std::pair<std::string, std::string>> changed_options(const CLI::App& app);
/// Names of the typed options that describe the run, also with their default value.
std::vector<std::string> typed_options(const CLI::App& app);

void declare_gait(CLI::App& app, WalkOptions& options);

void declare_tuning(CLI::App& app, WalkOptions& options);

/// declare_gait(), and the options for seed, trace, report, JSON.
void declare_basics(CLI::App& app, WalkOptions& options);

/// Physics step, start pose, falls.
void declare_twin(CLI::App& app, WalkOptions& options);

/// Both or neither must be CAN. Throws ToolError.
void require_fit(const std::string& command, const std::string& link, const Params& params);

/// Reads `robot_words`. Throws ToolError.
void read_robot_words(WalkOptions& options);

/// Throws ToolError for an option that describes the run: the scenario's file describes all of it.
void refuse_beside_scenario(const WalkOptions& options);

/// First and last of --seeds. Throws ToolError.
std::pair<std::uint64_t, std::uint64_t> seeds_of(const WalkOptions& options);

/// Step lengths of --sweep-step; empty without it. Throws ToolError.
std::vector<double> sweep_of(const WalkOptions& options);

/// --cycle, --set, --no-... . Throws ToolError for unknown names and values out of range.
std::map<std::string, double> tuning_of(const WalkOptions& options);
/// The orders of --stand, --velocity or --step.
scenario::Orders orders_of(const WalkOptions& options);

}  // namespace verp::tool
