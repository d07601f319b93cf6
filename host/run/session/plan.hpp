#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "common/record/tick_record.hpp"
#include "firmware/app/contracts.hpp"
#include "host/robot/model/entity.hpp"
#include "host/run/session/estimate_meter.hpp"
#include "host/run/session/intervention.hpp"
#include "host/trace/record/trace_writer.hpp"
#include "host/twin/sim/metrics.hpp"
#include "host/twin/sim/robot.hpp"

/// One run: a world and its robots, each with its bus, controller, operator, meter and trace. This
/// library knows no command lines, terminals or signals: the caller passes data and reads results.
namespace verp::session {

/// One tick of a controller in this process. The robot receives its Outputs; the trace records its
/// State.
using Decide = std::function<void(const Params&, State&, const Inputs&, Outputs&)>;

/// One walk of one robot, fully determined by these values and the world's.
struct WalkPlan {
  model::Entity entity;
  Params params;
  Command velocity;                    ///< vx, vy, wz
  std::optional<Command> asked = {};   ///< velocity to judge the walk by, if not `velocity`
  std::vector<std::uint32_t> actions;  ///< image of an action library (common/action)
  std::string remark;                  ///< how the plan deviates from the user's order
  double walk_s = 20;                  ///< of gait; of the run if Hooks::order gives the orders
  sim::TwinOptions twin;               ///< seed, start pose, variation
  /// Attempts in a row to get up after a fall, by an action of `actions`. 0: a fall ends the walk.
  int get_ups = 0;
  bool stands = false;  ///< stands for walk_s and steps only to keep its balance
  std::string board;    ///< emulated board of the controller; empty: this process
  /// Makes the user's controller (host/run/own) for one run, in place of the core; empty: the core.
  std::function<Decide()> own;
  /// Folder of the board's images with the user's controller; empty: this project's images.
  std::string firmware_folder;
  std::string link;  ///< to a controller elsewhere (remote_controller.hpp); empty: none
  std::string name;  ///< among the world's robots; empty: name in params
  int number = 0;    ///< in its scenario, from 0
  std::vector<Intervention> interventions;  ///< on the twin, in any order
};

/// State of one robot after a tick.
struct Tick {
  const sim::Observation& seen;
  double gone_s = 0;  ///< elapsed part of plan.walk_s
  /// Null for a controller that reports nothing.
  const TickRecord* record = nullptr;
  const State* state = nullptr;
  const Outputs* outputs = nullptr;
  const sim::World* world = nullptr;
  int owner = sim::kScenery;  ///< of this robot's contacts in `world`
};

/// An event of a robot's run, as text.
struct RunEvent {
  double at_s = 0;  ///< simulated time
  std::string what;
};

/// Callbacks of one robot's run; all may be empty. Session::tick() calls them in its caller's
/// thread, one at a time. In a run of several robots it calls `order` and `amend` on the robot's
/// own stack (Flow).
struct Hooks {
  /// Gives the orders in place of the walk's operator, once per tick. `tick`: last begun tick.
  std::function<app::OperatorOrder(std::uint32_t tick)> order;
  /// May change each order before the robot sends it (LiveOrders).
  std::function<void(std::uint32_t tick, app::OperatorOrder& order)> amend;
  /// Replaces the core's step() and WalkPlan::own. An exception ends the run.
  Decide decide;
  std::function<void(const Tick&)> ticked;
  /// Receives falls and recoveries.
  std::function<void(const RunEvent&)> told;
  /// Receives the exposures of the robot's cameras (plan.twin.cameras) up to the last recorded
  /// tick. stamp_ns: trace time. Calls end when `trace` fails.
  std::function<void(const sim::Exposure&, std::uint64_t stamp_ns)> exposed;
  /// Receives the robot's laser scans, with the same time stamp.
  std::function<void(const sim::Scan&, std::uint64_t stamp_ns)> scanned;
  record::TraceWriter* trace = nullptr;  ///< records every tick; must outlive the run
  bool keep_series = false;              ///< fills WalkResult::series
  bool open_end = false;  ///< only the caller ends the run; its length or a fall does not
};

/// Traffic on a CAN bus from the first tick on.
struct CanTraffic {
  double bits_per_tick = 0, bare_bits_per_tick = 0;  ///< with and without stuff bits
  std::uint32_t overruns = 0;                        ///< frames that the controller lost
};

struct WalkResult {
  sim::WalkMetrics metrics;
  EstimateErrors estimate;             ///< empty for a user's controller
  std::vector<sim::SeriesRow> series;  ///< from the first tick on
  std::uint64_t ticks = 0;
  std::uint64_t digest = 0;
  std::uint32_t faults = 0;          ///< safety::Fault bits at the end
  int falls = 0, get_ups = 0;        ///< as the controller counts them
  std::vector<RunEvent> fall_story;  ///< falls and recoveries
  double longest_step_m = 0;         ///< of the gait, after its limits
  double simulated_s = 0, wall_s = 0;
  sim::Vec2 end_m{0, 0};              ///< end position of the body, in the world
  std::vector<double> set_upright_s;  ///< simulated times at which the user set it upright
  std::vector<AppliedIntervention> interventions;  ///< the plan's and others
  bool interrupted = false;
  std::optional<CanTraffic> can;  ///< only over CAN
  std::string trace_failure;      ///< why the trace ended early; the walk went on
  std::string failure;            ///< why the walk failed; empty: it did not
  std::string remark;             ///< how a good walk deviates from the order

  bool good() const { return failure.empty() && !interrupted; }
  double real_time_factor() const { return wall_s > 0 ? simulated_s / wall_s : 0; }
};

}  // namespace verp::session
