#include "host/tool/walk_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "common/safety/machine.hpp"
#include "firmware/app/app.hpp"
#include "host/board/board_error.hpp"
#include "host/board/loop_on_target.hpp"
#include "host/bus/virtual_bus.hpp"
#include "host/record/trace_error.hpp"
#include "host/sim/planned_zmp.hpp"
#include "host/tool/exit_status.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/walk_operator.hpp"

namespace verp::tool {
namespace {

constexpr double kAfterFall_s = 0.5;  // the report should show how it fell
constexpr double kAfterStop_s = 0.3;  // and how it stands still

record::ros::BodyPose pose_of(const sim::Transform& body) {
  const Eigen::Quaterniond q(body.linear());
  const auto& p = body.translation();
  return {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

/// Twin, bus, operator, meter and trace of one walk; the controller is somewhere else.
class Session {
 public:
  Session(const WalkPlan& plan, record::TraceWriter* trace, Progress& progress, std::string label,
          bool keep_series)
      : plan_(plan),
        trace_(trace),
        progress_(progress),
        label_(std::move(label)),
        robot_(world_, plan.entity, twin_options(plan)),
        bus_(plan.params, robot_),
        walker_(plan.params, plan.velocity, plan.walk_s),
        meter_(plan.entity, keep_series) {}

  bus::VirtualBus& bus() { return bus_; }
  WalkOperator& walker() { return walker_; }
  bool over() const { return over_ || interrupted(); }

  /// A tick of the controller, wherever it ran.
  void record(const TickRecord& tick, const State& state, const Outputs& outputs) {
    walker_.observe(state, outputs);
    const gait::Xy by_m = state.gait.footsteps.stride.by_m;
    if (state.gait.queued > 0) {
      result_.longest_step_m =
          std::max(result_.longest_step_m,
                   std::hypot(static_cast<double>(by_m.x), static_cast<double>(by_m.y)));
    }
    const sim::Observation seen = sim::observe(robot_);
    meter_.tick(seen, outputs, sim::planned_zmp_world_m(state.tuning, state.gait, seen.truth));
    ++result_.ticks;
    result_.digest = tick.digest.chain;
    result_.faults = outputs.faults;
    if (trace_ != nullptr) {
      append(tick, state, outputs.faults, pose_of(seen.truth.body_world));
    }
    const bool ended = robot_.fallen() || walker_.done();
    after_s_ += ended ? plan_.params.period_us * 1e-6 : 0;
    over_ = after_s_ > (robot_.fallen() ? kAfterFall_s : kAfterStop_s);
    progress_.show(walker_.walked_s() / plan_.walk_s,
                   fmt::format("{}  {:.1f} of {:g} s", label_, walker_.walked_s(), plan_.walk_s));
  }

  WalkResult result(double wall_s, std::string failure) {
    result_.wall_s = wall_s;
    result_.simulated_s = static_cast<double>(world_.now_us()) * 1e-6;
    result_.interrupted = interrupted();
    result_.metrics = meter_.result();
    result_.series = meter_.series();
    result_.failure = std::move(failure);
    if (result_.failure.empty() && !result_.interrupted) result_.failure = failure_of_walk();
    if (result_.good() && walker_.longer_than_asked()) {
      result_.remark =
          fmt::format("{:g} s were asked; the shortest walk with this cycle is {:.2f} s",
                      plan_.walk_s, result_.metrics.walk_s);
    }
    return std::move(result_);
  }

 private:
  static sim::TwinOptions twin_options(const WalkPlan& plan) {
    sim::TwinOptions options;
    options.seed = plan.seed;
    return options;
  }

  /// A disk that is full costs the trace, not the walk.
  void append(const TickRecord& tick, const State& state, std::uint32_t faults,
              const record::ros::BodyPose& body) {
    try {
      trace_->append(tick, state, faults, &body);
    } catch (const record::TraceError& error) {
      result_.trace_failure = error.what();
      trace_ = nullptr;
    }
  }

  std::string failure_of_walk() const {
    constexpr std::uint32_t kStopping = 0xFFFF;  // the lower half of Fault stops the robot
    if (result_.metrics.fallen) {
      return fmt::format("fell after {:.2f} s of gait", walker_.walked_s());
    }
    const std::string faults = fault_names(result_.faults & kStopping);
    return faults.empty() ? walker_.failed() : "stopped by fault: " + faults;
  }

  const WalkPlan& plan_;
  record::TraceWriter* trace_;
  Progress& progress_;
  std::string label_;
  sim::World world_;
  sim::TwinRobot robot_;
  bus::VirtualBus bus_;
  WalkOperator walker_;
  sim::WalkMeter meter_;
  WalkResult result_;
  double after_s_ = 0;
  bool over_ = false;
};

using SilApp = app::App<bus::VirtualBus, WalkOperator, Session>;

void come_up(SilApp& app) {
  const app::BringUpReport report = app.bring_up();
  if (report.status == app::BringUpStatus::kReady) return;
  constexpr const char* kWhat[] = {"is ready", "does not answer", "is of another model",
                                   "refuses a write", "does not keep what is written"};
  throw ToolError(kNoDevice, fmt::format("bus: device {} {} (register {}); check ids in the model",
                                         report.device_id, kWhat[static_cast<int>(report.status)],
                                         report.address));
}

void run_here(const WalkPlan& plan, Session& session) {
  SilApp app(plan.params, session.bus(), session.walker(), session);
  come_up(app);
  while (!session.over()) app.tick();
}

/// The controller runs in firmware; the same core runs along here, for its State and Outputs and to
/// hold every digest against the board's. Returns what went wrong, or nothing.
std::string run_on_board(const WalkPlan& plan, Session& session) {
  State state;
  std::string failure;
  const auto record = [&](const TickRecord& tick) {
    if (session.over() || !failure.empty()) return;  // the board finishes the tick it is in
    Outputs outputs;
    step(plan.params, state, tick.inputs, outputs);
    for (int stage = kStages - 1; stage >= 0; --stage) {
      if (state.digest.stage[stage] == tick.digest.stage[stage]) continue;
      failure = fmt::format("{} differs from this PC at tick {} in stage {}", plan.board,
                            tick.inputs.tick, kStageNames[stage]);
    }
    session.record(tick, state, outputs);
  };
  bus::ServerHooks hooks;
  hooks.order = [&](std::uint32_t tick) { return session.walker().order(tick); };
  hooks.record = record;
  hooks.stop = [&] { return session.over() || !failure.empty(); };
  try {
    const bus::ServerResult ended =
        board::run_loop_on(plan.board, plan.params, session.bus(), hooks, bus::RunOptions{});
    return failure.empty() && ended.exit_code != 0 ? plan.board + ": " + ended.reason : failure;
  } catch (const board::BoardError&) {
    if (!interrupted()) throw;  // Ctrl-C in a terminal ends the emulator too
    return failure;
  }
}

}  // namespace

WalkResult walk(const WalkPlan& plan, record::TraceWriter* trace, Progress& progress,
                const std::string& label, bool keep_series) {
  using Clock = std::chrono::steady_clock;
  Session session(plan, trace, progress, label, keep_series);
  const auto start = Clock::now();
  std::string failure;
  if (plan.board.empty()) {
    run_here(plan, session);
  } else {
    failure = run_on_board(plan, session);
  }
  return session.result(std::chrono::duration<double>(Clock::now() - start).count(),
                        std::move(failure));
}

std::string fault_names(std::uint32_t faults) {
  constexpr std::pair<std::uint32_t, const char*> kNames[] = {
      {safety::kFaultFall, "fall"},
      {safety::kFaultEmergency, "emergency stop"},
      {safety::kFaultServoSilent, "servo silent"},
      {safety::kFaultImuSilent, "IMU silent"},
      {safety::kFaultOperatorQuiet, "operator silent"},
      {safety::kFaultTemperature, "servo too hot"},
      {safety::kFaultVoltage, "voltage low"},
      {safety::kFaultServoError, "servo hardware error"},
      {safety::kNoteOverrun, "tick overran"},
      {safety::kNoteParameter, "parameter refused"},
      {safety::kNoteStrideLimited, "stride limited"},
      {safety::kNotePlanShortened, "steps shortened"},
      {safety::kNotePlanRefused, "plan refused"},
      {safety::kNoteLegLimited, "leg out of reach"},
      {safety::kNoteSpeedLimited, "joint speed limited"},
  };
  std::string text;
  for (const auto& [bit, name] : kNames) {
    if ((faults & bit) == 0) continue;
    text += (text.empty() ? "" : ", ") + std::string(name);
  }
  return text;
}

}  // namespace verp::tool
