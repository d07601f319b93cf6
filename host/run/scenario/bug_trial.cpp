#include <fmt/format.h>

#include <cmath>

#include "common/safety/machine.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/run/scenario/field_bugs.hpp"
#include "host/run/session/not_up.hpp"
#include "host/run/session/session.hpp"

namespace verp::scenario {
namespace {

constexpr double kLength_s = 5;
constexpr std::uint32_t kStops = 0xFFFF;  // faults; the others are notes

/// When the table first answered or the robot fell, since the bug began.
class Stopwatch {
 public:
  explicit Stopwatch(const session::WalkPlan& plan) {
    for (const session::Intervention& each : plan.interventions) begins_s_ = each.at_s;
    if (plan.fault) begins_s_ = plan.fault->at_s;
  }
  void tick(const session::Tick& tick) {
    if (tick.gone_s >= begins_s_ && begun_s_ < 0) begun_s_ = tick.seen.truth.t_s;
    const bool faulty = tick.outputs != nullptr && (tick.outputs->faults & kStops) != 0;
    if (begun_s_ < 0 || after_s >= 0 || !(faulty || tick.seen.truth.fallen)) return;
    after_s = tick.seen.truth.t_s - begun_s_;
  }
  double after_s = -1;

 private:
  double begins_s_ = -1, begun_s_ = -1;
};

Trial walk(const FieldBug& bug, const model::Entity& entity) {
  Robot robot;
  robot.fault = bug.name;
  robot.orders = Velocity{.vx_m_s = 0.15};
  const session::WalkPlan plan = plan_of(robot, kLength_s, entity);
  Stopwatch watch(plan);
  session::Options options;
  options.world.step_us = 2000;
  session::Hooks hooks;
  hooks.ticked = [&](const session::Tick& tick) { watch.tick(tick); };
  const session::WalkResult result = session::walk(plan, std::move(hooks), std::move(options));
  const std::string& line = result.failure;
  Trial trial{.after_s = watch.after_s, .line = "verp walk: " + line};
  if (line.empty() && result.remark.empty()) return {.line = "none: the walk looks healthy"};
  if (line.empty()) return {.catcher = Catcher::kTwin, .line = "remark: " + result.remark};
  const bool table = (result.faults & kStops & ~safety::kFaultFall) != 0;
  trial.catcher = table ? Catcher::kTable : Catcher::kTwin;
  return trial;
}

}  // namespace

Trial try_bug(const FieldBug& bug, const model::Entity& entity) {
  try {
    return walk(bug, entity);
  } catch (const model::LoadError& error) {
    return {.catcher = Catcher::kCheck, .line = error.what()};
  } catch (const session::NotUp& error) {
    return {.catcher = Catcher::kBringUp, .line = std::string("verp walk: ") + error.what()};
  }
}

const char* in_words(BugFamily family) {
  constexpr const char* kWords[] = {"Bus and link", "Servos", "IMU", "Model", "Power and people"};
  return kWords[static_cast<int>(family)];
}

const char* in_words(Catcher catcher) {
  constexpr const char* kWords[] = {"check, before torque", "bring-up, before torque",
                                    "the safety table", "the twin", "nobody"};
  return kWords[static_cast<int>(catcher)];
}

}  // namespace verp::scenario
