#include "host/run/session/controller.hpp"

#include <fmt/format.h>

#include <utility>

#include "firmware/app/app.hpp"
#include "host/boards/board/board_error.hpp"
#include "host/boards/board/loop_on_target.hpp"
#include "host/run/session/flow.hpp"
#include "host/run/session/not_up.hpp"
#include "host/run/session/operator_console.hpp"

namespace verp::session {
namespace {

struct Law {
  Robot* robot = nullptr;
  void operator()(const Params&, State& state, const Inputs& inputs, Outputs& outputs) {
    robot->decide(state, inputs, outputs);
  }
};

template <class Bus>
class LocalController final : public Controller {
 public:
  LocalController(Robot& robot, Bus& bus)
      : robot_(robot),
        desk_(robot),
        app_(robot.plan().params, bus, desk_, desk_, nullptr, {&robot}) {}

  bool tick() override {
    if (!std::exchange(up_, true)) bring_up();
    app_.tick();
    return true;
  }

 private:
  void bring_up() {
    const app::BringUpReport report = app_.bring_up();
    desk_.brought_up(report);
    if (report.status == app::BringUpStatus::kReady) return;
    const bool can = robot_.plan().params.bus_protocol == BusProtocol::kCia402;
    throw not_up(report, "the twin's bus",
                 can ? fmt::format("object {:04X}h", report.address)
                     : fmt::format("register {}", report.address));
  }

  Robot& robot_;
  OperatorConsole desk_;
  app::App<Bus, OperatorConsole, OperatorConsole, app::NoImu, Law> app_;
  bool up_ = false;
};

/// The board runs its own loop; each tick() runs it to the end of one tick.
class BoardController final : public Controller {
 public:
  explicit BoardController(Robot& robot)
      : robot_(robot), flow_([this](Flow& flow) { run(flow); }) {}

  bool tick() override {
    if (flow_.resume()) return true;
    robot_.fail(failure_);
    return false;
  }
  void finish() override {
    if (!flow_.resume()) robot_.fail(failure_);
  }

 private:
  void run(Flow& flow) {
    bus::ServerHooks hooks;
    hooks.order = [&](std::uint32_t tick) { return robot_.order(tick); };
    hooks.stop = [&] { return robot_.over() || !failure_.empty(); };
    hooks.record = [&](const TickRecord& tick) {
      if (hooks.stop()) return;  // the board finishes its tick
      compare(tick);
      flow.pause();
    };
    const std::string& board = robot_.plan().board;
    try {
      const bus::ServerResult ended =
          board::run_loop_on(board, robot_.plan().params, robot_.bus(), hooks,
                             {.actions = robot_.plan().actions}, robot_.plan().firmware_folder);
      if (failure_.empty() && ended.exit_code != 0) failure_ = board + ": " + ended.reason;
    } catch (const board::BoardError&) {
      if (!robot_.interrupted()) throw;  // Ctrl-C also ends the emulator
    }
  }

  void compare(const TickRecord& tick) {
    Outputs outputs;
    robot_.decide(state_, tick.inputs, outputs);
    for (int stage = kStages - 1; stage >= 0; --stage) {
      if (state_.digest.stage[stage] == tick.digest.stage[stage]) continue;
      failure_ = fmt::format("{} differs from this PC at tick {} in stage {}", robot_.plan().board,
                             tick.inputs.tick, kStageNames[stage]);
    }
    if (failure_.empty() && state_.digest.chain != tick.digest.chain) {
      failure_ = fmt::format("{} differs from this PC at tick {} in what is sent",
                             robot_.plan().board, tick.inputs.tick);
    }
    robot_.take(tick, state_, outputs);
  }

  Robot& robot_;
  State state_;  ///< of the core that runs here
  std::string failure_;
  Flow flow_;
};

}  // namespace

std::unique_ptr<Controller> make_controller(Robot& robot) {
  if (!robot.plan().board.empty()) return std::make_unique<BoardController>(robot);
  if (robot.plan().params.bus_protocol == BusProtocol::kCia402) {
    return std::make_unique<LocalController<can::VirtualCan>>(robot, robot.can());
  }
  return std::make_unique<LocalController<bus::VirtualBus>>(robot, robot.bus());
}

}  // namespace verp::session
