#include "host/tool/walk_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "common/safety/machine.hpp"
#include "firmware/app/app.hpp"
#include "host/bus/virtual_bus.hpp"
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

/// Where the app's ticks go: operator, meter and trace.
struct Desk {
  WalkOperator& walker;
  sim::WalkMeter& meter;
  sim::TwinRobot& robot;
  record::TraceWriter* trace;
  WalkResult& result;

  void record(const TickRecord& tick, const State& state, const Outputs& outputs) {
    walker.observe(tick.inputs.tick, outputs);
    const sim::Observation seen = sim::observe(robot);
    meter.tick(seen, outputs);
    ++result.ticks;
    result.digest = tick.digest.chain;
    result.faults = outputs.faults;
    if (trace == nullptr) return;
    const record::ros::BodyPose body = pose_of(seen.truth.body_world);
    trace->append(tick, state, outputs.faults, &body);
  }
};

using SilApp = app::App<bus::VirtualBus, WalkOperator, Desk>;

void come_up(SilApp& app) {
  const app::BringUpReport report = app.bring_up();
  if (report.status == app::BringUpStatus::kReady) return;
  constexpr const char* kWhat[] = {"is ready", "does not answer", "is of another model",
                                   "refuses a write", "does not keep what is written"};
  throw ToolError(kNoDevice, fmt::format("bus: device {} {} (register {}); check ids in the model",
                                         report.device_id, kWhat[static_cast<int>(report.status)],
                                         report.address));
}

std::string failure_of(const WalkOperator& walker, const WalkResult& result) {
  constexpr std::uint32_t kStopping = 0xFFFF;  // the lower half of Fault stops the robot
  if (result.metrics.fallen) return fmt::format("fell after {:.2f} s of gait", walker.walked_s());
  const std::string faults = fault_names(result.faults & kStopping);
  if (!faults.empty()) return "stopped by fault: " + faults;
  return walker.failed();
}

}  // namespace

WalkResult walk(const WalkPlan& plan, record::TraceWriter* trace, Progress& progress,
                const std::string& label, bool keep_series) {
  using Clock = std::chrono::steady_clock;
  WalkResult result;
  sim::World world;
  sim::TwinOptions options;
  options.seed = plan.seed;
  sim::TwinRobot robot(world, plan.entity, options);
  bus::VirtualBus bus(plan.params, robot);
  WalkOperator walker(plan.params, plan.velocity, plan.walk_s);
  sim::WalkMeter meter(plan.entity, keep_series);
  Desk desk{walker, meter, robot, trace, result};
  SilApp app(plan.params, bus, walker, desk);
  come_up(app);

  const auto start = Clock::now();
  const double period_s = plan.params.period_us * 1e-6;
  double after_s = 0;
  for (bool over = false; !over && !interrupted();) {
    app.tick();
    const bool ended = robot.fallen() || walker.done();
    after_s += ended ? period_s : 0;
    over = after_s > (robot.fallen() ? kAfterFall_s : kAfterStop_s);
    progress.show(walker.walked_s() / plan.walk_s,
                  fmt::format("{}  {:.1f} of {:g} s", label, walker.walked_s(), plan.walk_s));
  }
  result.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  result.simulated_s = static_cast<double>(world.now_us()) * 1e-6;
  result.interrupted = interrupted();
  result.metrics = meter.result();
  result.series = meter.series();
  if (!result.interrupted) result.failure = failure_of(walker, result);
  return result;
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
