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

/// One run: a world, the robots in it, each with its bus, controller, operator, meter and record.
/// Knows no words, options, terminals or signals: who uses it gives what it needs and asks how it
/// went.
namespace verp::session {

/// One tick of a controller in this process: what it leaves in Outputs is sent, what it leaves in
/// State is recorded.
using Decide = std::function<void(const Params&, State&, const Inputs&, Outputs&)>;

/// One walk of one robot, fully determined by these values and the world's.
struct WalkPlan {
  model::Entity entity;
  Params params;
  Command velocity;                    ///< vx, vy, wz
  std::optional<Command> asked = {};   ///< what a walk is judged by, if more than the velocity
  std::vector<std::uint32_t> actions;  ///< image of the library (common/action); empty: none
  std::string remark;                  ///< how that is not what was asked; goes into the result's
  double walk_s = 20;     ///< of gait; of a run whose orders come from Hooks::order: of the run
  sim::TwinOptions twin;  ///< seed, where it stands, what of it varies
  /// How often in a row the operator has it try to get up once it lies; 0: it lies, and a fall ends
  /// the walk. `actions` hold how.
  int get_ups = 0;
  bool stands = false;  ///< for walk_s, in place of a walk: it steps only where it has to
  std::string board;    ///< emulated board that runs the controller; empty: this process
  /// A controller of somebody's own in place of the core (host/run/own), made for one run; empty:
  /// none.
  std::function<Decide()> own;
  /// Where that board's images are, with such a controller in them; empty: those of this project.
  std::string firmware_folder;
  std::string
      link;  ///< at whose other end its controller is (remote_controller.hpp); empty: it is not
  std::string name;  ///< among other robots of the world; empty: as params have it
  int number = 0;    ///< among the robots of its scenario, from 0 on
  std::vector<Intervention> interventions;  ///< of what is done to the twin, in any order
};

/// What there is to see after a tick of one robot.
struct Tick {
  const sim::Observation& seen;
  double gone_s = 0;  ///< of plan.walk_s
  /// Null of a controller that tells nothing of itself.
  const TickRecord* record = nullptr;
  const State* state = nullptr;
  const Outputs* outputs = nullptr;
  const sim::World* world = nullptr;  ///< and whose contacts in it are this robot's
  int owner = sim::kScenery;
};

/// Something that became of a robot, in words.
struct RunEvent {
  double at_s = 0;  ///< simulated time
  std::string what;
};

/// What a user wants of one robot's run. Empty members are allowed. All are called during
/// Session::tick(), by the thread that called it, and never at the same time; of one of several
/// robots `order` and `amend` are called on a stack of its own (Flow).
struct Hooks {
  /// Orders in place of the walk's own; asked once a tick, with the number of the last one begun.
  std::function<app::OperatorOrder(std::uint32_t tick)> order;
  /// Sees each order before it goes out, whoever gave it, and may change it (LiveOrders).
  std::function<void(std::uint32_t tick, app::OperatorOrder& order)> amend;
  /// In place of the core's step(), and of the plan's own. It may throw, which ends the run.
  Decide decide;
  std::function<void(const Tick&)> ticked;
  /// What becomes of a robot that falls, lies or gets up.
  std::function<void(const RunEvent&)> told;
  /// When the robot's cameras looked (plan.twin.cameras), up to the tick that was just recorded;
  /// stamp_ns: as the trace counts time. Not called any more once a trace that was given breaks
  /// off.
  std::function<void(const sim::Exposure&, std::uint64_t stamp_ns)> exposed;
  /// What its lasers measured, as they come, stamped likewise.
  std::function<void(const sim::Scan&, std::uint64_t stamp_ns)> scanned;
  record::TraceWriter* trace = nullptr;  ///< gets every tick; must outlive the run
  bool keep_series = false;              ///< WalkResult::series
  bool open_end = false;  ///< neither its length nor a fall ends the run: its user does
};

/// What a CAN bus carried in a walk, from its first tick on.
struct CanTraffic {
  double bits_per_tick = 0, bare_bits_per_tick = 0;  ///< with and without stuff bits
  std::uint32_t overruns = 0;                        ///< frames that the controller lost
};

struct WalkResult {
  sim::WalkMetrics metrics;
  EstimateErrors estimate;             ///< of the core: a controller of somebody's own makes none
  std::vector<sim::SeriesRow> series;  ///< from the first tick on
  std::uint64_t ticks = 0;
  std::uint64_t digest = 0;
  std::uint32_t faults = 0;          ///< safety::Fault bits at the end
  int falls = 0, get_ups = 0;        ///< as the controller saw them
  std::vector<RunEvent> fall_story;  ///< of each fall and of getting up; of what the plan lets it
  double longest_step_m = 0;  ///< that the gait made: the asked one, or what limits left of it
  double simulated_s = 0, wall_s = 0;
  sim::Vec2 end_m{0, 0};              ///< where its body was then, in the world
  std::vector<double> set_upright_s;  ///< when somebody set it on its feet, simulated time
  std::vector<AppliedIntervention> interventions;  ///< what of the plan's was done, and what else
  bool interrupted = false;
  std::optional<CanTraffic> can;  ///< of a walk over CAN
  std::string trace_failure;  ///< why the trace breaks off; the walk went on. Empty: it does not
  std::string failure;        ///< why the walk is no good, in words; empty: it is good
  std::string remark;         ///< how a good walk is not what was asked; empty: it is

  bool good() const { return failure.empty() && !interrupted; }
  double real_time_factor() const { return wall_s > 0 ? simulated_s / wall_s : 0; }
};

}  // namespace verp::session
