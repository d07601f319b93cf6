#pragma once
#include <cstdint>
#include <functional>
#include <memory>
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
#include "host/twin/bus/faulty_line.hpp"
#include "host/twin/sim/metrics.hpp"
#include "host/twin/sim/robot.hpp"

namespace verp::session {

/// One tick of a controller in this process: Outputs for the robot, State for the trace.
using Decide = std::function<void(const Params&, State&, const Inputs&, Outputs&)>;

/// Robots begin at least this far from each other.
inline constexpr double kLeastApart_m = 0.1;

class Robot;

/// A mistake in a run beyond the quantities of its physics (scenario/field_bugs.hpp). Members
/// may be empty.
struct Fault {
  double at_s = -1;  ///< time in the run as for Intervention; negative: before the bring-up
  std::optional<bus::LineFaults> line = {};
  std::function<void(Params&)> devices = {};            ///< as they are, not as Params say
  std::function<void(Robot&)> begin = {};               ///< once
  std::function<void(Robot&)> each_tick = {};           ///< from then on
  std::function<void(app::OperatorOrder&)> amend = {};  ///< likewise
};

/// One walk of one robot, determined by these values and the world's.
struct WalkPlan {
  model::Entity entity;
  Params params;
  Command velocity;                    ///< vx, vy, wz
  std::optional<Command> asked = {};   ///< velocity to judge the walk by, if not `velocity`
  std::vector<std::uint32_t> actions;  ///< an action library's image (common/action)
  std::string remark;                  ///< deviation from the user's order
  double walk_s = 20;     ///< length of gait; of the whole run if Hooks::order gives the orders
  sim::TwinOptions twin;  ///< seed, start pose, variation
  /// Attempts in a row after a fall, by an action of `actions`. 0: a fall ends the walk.
  int get_ups = 0;
  bool stands = false;  ///< steps only to keep its balance
  std::string board;    ///< emulated; empty: this process
  /// A user's controller (host/run/own) for one run; empty: the core.
  std::function<Decide()> own;
  /// Board's images with the user's controller; empty: this project's.
  std::string firmware_folder;
  std::string link;  ///< controller elsewhere (remote_controller.hpp); empty: none
  std::string name;  ///< empty: name in params
  int number = 0;    ///< in its scenario
  std::vector<Intervention> interventions;  ///< in any order
  std::shared_ptr<const Fault> fault;       ///< null: none
};

/// State of a robot after a tick.
struct Tick {
  const sim::Observation& seen;
  double gone_s = 0;  ///< elapsed part of plan.walk_s
  /// Null: the controller reports nothing.
  const TickRecord* record = nullptr;
  const State* state = nullptr;
  const Outputs* outputs = nullptr;
  const sim::World* world = nullptr;
  int owner = sim::kScenery;  ///< for its contacts in `world`
};

struct RunEvent {
  double at_s = 0;  ///< simulated time
  std::string what;
};

/// Callbacks for one robot's run; all may be empty. Called in the thread of Session::tick(). With
/// several robots, `order` and `amend` run on the robot's own stack (Flow).
struct Hooks {
  /// Replaces the walk's operator, once per tick. `tick`: last begun tick.
  std::function<app::OperatorOrder(std::uint32_t tick)> order;
  /// Changes an order before it is sent (LiveOrders).
  std::function<void(std::uint32_t tick, app::OperatorOrder& order)> amend;
  /// Replaces step() and WalkPlan::own; an exception ends the run.
  Decide decide;
  std::function<void(const Tick&)> ticked;
  /// Receives falls and recoveries.
  std::function<void(const RunEvent&)> told;
  /// Exposures of the robot's cameras (plan.twin.cameras) up to the last recorded tick. stamp_ns:
  /// trace time. Ends when `trace` fails.
  std::function<void(const sim::Exposure&, std::uint64_t stamp_ns)> exposed;
  /// Laser scans, with the same stamp.
  std::function<void(const sim::Scan&, std::uint64_t stamp_ns)> scanned;
  record::TraceWriter* trace = nullptr;  ///< every tick; must outlive the run
  bool keep_series = false;              ///< fills WalkResult::series
  bool open_end = false;                 ///< only the caller ends the run, no fall or length
};

/// Traffic on a CAN bus from the first tick on.
struct CanTraffic {
  double bits_per_tick = 0, bare_bits_per_tick = 0;  ///< with and without stuff bits
  std::uint32_t overruns = 0;                        ///< lost by the controller
};

struct WalkResult {
  sim::WalkMetrics metrics;
  EstimateErrors estimate;  ///< empty for a user's controller
  std::vector<sim::SeriesRow> series;
  std::uint64_t ticks = 0;
  std::uint64_t digest = 0;
  std::uint32_t faults = 0;          ///< at the end
  int falls = 0, get_ups = 0;        ///< counted by the controller
  std::vector<RunEvent> fall_story;  ///< falls and recoveries
  double longest_step_m = 0;         ///< of the gait, after its limits
  double simulated_s = 0, wall_s = 0;
  sim::Vec2 end_m{0, 0};              ///< the body's end position in the world
  std::vector<double> set_upright_s;  ///< simulated times at which the user set it upright
  std::vector<AppliedIntervention> interventions;  ///< the plan's and others
  bool interrupted = false;
  std::optional<CanTraffic> can;  ///< only over CAN
  std::string trace_failure;      ///< why the trace ended early; the walk went on
  std::string failure;            ///< why the walk failed; or empty
  std::string remark;             ///< how a good walk deviates from the order

  bool good() const { return failure.empty() && !interrupted; }
  double real_time_factor() const { return wall_s > 0 ? simulated_s / wall_s : 0; }
};

}  // namespace verp::session
