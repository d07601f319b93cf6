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

/// What --compress does, wherever it is.
inline constexpr const char* kCompress =
    "compress the trace's chunks by zstd: about a fifth of the bytes";

/// The command line of `verp walk`, checked.
struct WalkOptions {
  std::string model = "generic21";
  std::string bus;  ///< by name; empty: the model's first
  double step_m = 0.04;
  double cycle_s = 0;  ///< 0: the robot's own
  double walk_s = 20;
  std::uint64_t seed = 1;
  std::string velocity_text, sweep_text, record_file, report_folder, board;
  std::string controller;             ///< a folder (verp new controller); empty: the core decides
  std::vector<std::string> settings;  ///< NAME=VALUE
  std::string command = "verp walk";  ///< that complains
  bool no_multibody = false, no_feedback = false, no_gravity = false, no_zeros = false;
  bool record_state = false, compress = false, json = false;
  bool stand = false;              ///< in place of a walk
  bool get_up = false;             ///< a fall does not end the walk
  std::string start = "standing";  ///< or lying:SIDE
  bool vary = false;  ///< the twin is another robot of this kind (host/twin/sim/vary.hpp)
  std::vector<std::pair<std::string, std::string>>
      changed;                 ///< what is not as by default, in words
  std::string seeds_text;      ///< A-B: these seeds, one after the other
  double physics_step_ms = 1;  ///< 2: half as long a wait
  TouchOptions touch;
  PlaceOptions place;
  MapOptions map;
  TeamOptions team;
  std::string scenario_file;  ///< in place of all options that describe a run
  bool print_scenario = false;
  std::optional<std::string> radio;      ///< its numbers in words; none: nobody has one
  std::vector<std::string> robot_words;  ///< of `verp walk`: MODEL, --robot
  bool model_given = false;
  LiveOptions live;
  bool cameras = false;    ///< what they see goes into the trace
  bool real_time = false;  ///< no faster than time goes by

  /// Whether that option is not as by default.
  bool changes(const std::string& option) const;
};

void declare(CLI::App& app, WalkOptions& options);

/// Of the command line's options that change a run, those that are not as by default: name, value.
std::vector<std::pair<std::string, std::string>> changed_options(const CLI::App& app);

/// Those of them that say which robot walks how far.
void declare_gait(CLI::App& app, WalkOptions& options);

/// Those of them that change the robot's tuning.
void declare_tuning(CLI::App& app, WalkOptions& options);

/// declare_gait(), and what is kept of the walk in the twin.
void declare_basics(CLI::App& app, WalkOptions& options);

/// Those of them that say what falls mean: --get-up, --start.
void declare_falls(CLI::App& app, WalkOptions& options);

/// For what speaks to Dynamixel servos only. Throws ToolError if the robot's bus has others.
void require_serial(const std::string& command, const model::Entity& entity);
/// Throws ToolError unless the robot's bus is CAN where `link` is a CAN interface, and only there.
void require_fit(const std::string& command, const std::string& link, const Params& params);

/// Takes MODEL and the robots with names of their own out of `robot_words`. Throws ToolError.
void read_robot_words(WalkOptions& options);

/// A file describes a whole run. Throws ToolError for an option that says something else of it.
void refuse_beside_scenario(const WalkOptions& options);

/// First and last of --seeds. Throws ToolError.
std::pair<std::uint64_t, std::uint64_t> seeds_of(const WalkOptions& options);

/// Step lengths of --sweep-step; empty when it was not given. Throws ToolError.
std::vector<double> sweep_of(const WalkOptions& options);

/// What --cycle, --set and --no-... change of the robot's tuning. Throws ToolError for unknown
/// names and values out of range.
std::map<std::string, double> tuning_of(const WalkOptions& options);
/// --stand, --velocity or --step. Throws ToolError.
scenario::Orders orders_of(const WalkOptions& options);

}  // namespace verp::tool
