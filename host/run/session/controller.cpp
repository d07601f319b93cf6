#include "host/run/session/controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "firmware/app/app.hpp"
#include "firmware/app/operator_device.hpp"
#include "firmware/app/pacer.hpp"
#include "host/boards/board/board_error.hpp"
#include "host/boards/board/loop_on_target.hpp"
#include "host/run/session/flow.hpp"
#include "host/run/session/not_up.hpp"
#include "host/twin/bus/bus_clock.hpp"
#include "host/twin/bus/order_packets.hpp"
#include "host/twin/bus/order_sink.hpp"

namespace verp::session {
namespace {

/// As on a board, the controller is device 200 and orders are register writes, so it rejects the
/// same.
class OperatorConsole {
 public:
  explicit OperatorConsole(Robot& robot);

  void brought_up(const app::BringUpReport& report) { device_.brought_up(report); }
  /// Throws bus::SinkError if the controller rejects an order.
  app::OperatorOrder order(std::uint32_t tick);
  void record(const TickRecord& tick, const State& state, const Outputs& outputs);

 private:
  /// The controller's end; the buffers are the other.
  struct Wire final : hal::ByteLink {
    std::size_t write(const std::uint8_t* data, std::size_t size, std::uint32_t) override {
      told.insert(told.end(), data, data + size);
      return size;
    }
    std::size_t read(std::uint8_t* buffer, std::size_t capacity, std::uint32_t) override {
      const std::size_t count = std::min(capacity, asked.size());
      std::copy_n(asked.begin(), count, buffer);
      asked.erase(asked.begin(), asked.begin() + static_cast<std::ptrdiff_t>(count));
      return count;
    }
    bool connected() const override { return true; }
    hal::LinkErrors errors() const override { return {}; }
    std::vector<std::uint8_t> asked, told;
  };

  void hand_over(std::size_t packets);

  Robot& robot_;
  Wire wire_;
  app::OperatorDevice device_;
  bool relaxed_ = false;  ///< without it a new controller obeys no order
  bool stopped_ = false;  ///< emergency stop
};

OperatorConsole::OperatorConsole(Robot& robot)
    : robot_(robot),
      device_(wire_, robot.plan().params,
              app::OperatorSetup{.self_test = app::table::SelfTest::kNotRun}) {
  device_.offer_actions(robot.actions().count());
}

app::OperatorOrder OperatorConsole::order(std::uint32_t tick) {
  const app::OperatorOrder wanted = robot_.order(tick);
  const bool stop = (wanted.flags & kEmergencyStop) != 0;
  const bool changed = std::exchange(stopped_, stop) != stop;
  if (changed || (wanted.flags & (kCommandFresh | kParameterWrite)) != 0) {
    std::size_t packets = 0;
    // Sends the required first order, relax: no person stands beside a twin.
    if (!std::exchange(relaxed_, true)) {
      bus::append_write(wire_.asked, app::reg("request"),
                        {static_cast<std::uint8_t>(Request::kRelax)});
      ++packets;
    }
    hand_over(packets + bus::append_order(wire_.asked, wanted));
  }
  return device_.order(tick);
}

void OperatorConsole::hand_over(std::size_t packets) {
  wire_.told.clear();
  while (device_.poll()) {
  }
  std::size_t answers = 0;
  dxl::Parser parser;
  for (const std::uint8_t byte : wire_.told) {
    for (bool found = parser.push(byte); found; found = parser.next()) {
      const int error = parser.packet().error & ~dxl::kAlert;
      if (error != 0) {
        throw bus::SinkError("the controller refuses an order (error " + std::to_string(error) +
                             "); see firmware/app/registers.md for what registers take");
      }
      ++answers;
    }
  }
  if (answers != packets) throw bus::SinkError("the controller does not answer its operator");
}

void OperatorConsole::record(const TickRecord& tick, const State& state, const Outputs& outputs) {
  device_.record(tick, state, outputs);
  robot_.take(tick, state, outputs);
}

struct Law {
  Robot* robot = nullptr;
  void operator()(const Params&, State& state, const Inputs& inputs, Outputs& outputs) {
    robot->decide(state, inputs, outputs);
  }
};

/// In lockstep the bus paces the loop.
template <class Bus>
struct LoopPace {
  explicit LoopPace(Bus&) {}
  void start(std::uint32_t) {}
  app::Beat next() { return {}; }
};
template <>
struct LoopPace<bus::FaultyLine> {
  explicit LoopPace(bus::FaultyLine& line) : clock(line), pacer(clock) {}
  void start(std::uint32_t period_us) { pacer.start(period_us); }
  app::Beat next() { return pacer.next(); }
  bus::BusClock<bus::FaultyLine> clock;
  app::Pacer<bus::BusClock<bus::FaultyLine>> pacer;
};

template <class Bus>
class LocalController final : public Controller {
 public:
  LocalController(Robot& robot, Bus& bus)
      : robot_(robot),
        desk_(robot),
        app_(robot.plan().params, bus, desk_, desk_, nullptr, {&robot}),
        pace_(bus) {}

  bool tick() override {
    if (!std::exchange(up_, true)) bring_up();
    app_.tick(pace_.next());
    return true;
  }

 private:
  void bring_up() {
    const app::BringUpReport report = app_.bring_up();
    desk_.brought_up(report);
    pace_.start(robot_.plan().params.period_us);
    if (report.status == app::BringUpStatus::kReady) return;
    const bool can = robot_.plan().params.bus_protocol == BusProtocol::kCia402;
    throw not_up(report, "the twin's bus",
                 can ? fmt::format("object {:04X}h", report.address)
                     : fmt::format("register {}", report.address));
  }

  Robot& robot_;
  OperatorConsole desk_;
  app::App<Bus, OperatorConsole, OperatorConsole, app::NoImu, Law> app_;
  LoopPace<Bus> pace_;
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
  if (robot.line() != nullptr)
    return std::make_unique<LocalController<bus::FaultyLine>>(robot, *robot.line());
  return std::make_unique<LocalController<bus::VirtualBus>>(robot, robot.bus());
}

}  // namespace verp::session
