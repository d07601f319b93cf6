#include "host/tool/walk_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "common/safety/machine.hpp"
#include "firmware/app/app.hpp"
#include "host/board/board_error.hpp"
#include "host/board/loop_on_target.hpp"
#include "host/bus/virtual_bus.hpp"
#include "host/can/virtual_can.hpp"
#include "host/tool/exit_status.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/robot_loop.hpp"
#include "host/tool/walk_session.hpp"

namespace verp::tool {
namespace {

void require_ready(const app::BringUpReport& report, BusProtocol protocol) {
  if (report.status == app::BringUpStatus::kReady) return;
  const std::string where = protocol == BusProtocol::kCia402
                                ? fmt::format("object {:04X}h", report.address)
                                : fmt::format("register {}", report.address);
  throw not_up(report, "the twin's bus", where);
}

template <class Bus>
void run_here(const WalkPlan& plan, WalkSession& session, Bus& bus) {
  app::App<Bus, WalkOperator, WalkSession> app(plan.params, bus, session.walker(), session);
  require_ready(app.bring_up(), plan.params.bus_protocol);
  while (!session.over()) app.tick();
}

/// The controller runs in firmware; the same core runs along here, for its State and Outputs and to
/// hold every digest against the board's. Returns what went wrong, or nothing.
std::string run_on_board(const WalkPlan& plan, WalkSession& session) {
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
  WalkSession session(plan, trace, progress, label, keep_series);
  const auto start = Clock::now();
  std::string failure;
  if (plan.board.empty()) {
    if (plan.params.bus_protocol == BusProtocol::kCia402) {
      run_here(plan, session, session.can());
    } else {
      run_here(plan, session, session.bus());
    }
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
