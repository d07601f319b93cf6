#include "host/apps/tool/robot/run_can.hpp"

#include <fmt/format.h>

#include <optional>

#include "common/protocol/canopen/cia402.hpp"
#include "common/protocol/canopen/robot_load.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "firmware/app/can_schedule.hpp"
#include "firmware/app/operator_node.hpp"
#include "firmware/app/tick_log.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/tool/robot/can_neighbours.hpp"
#include "host/apps/tool/robot/robot_loop.hpp"
#include "host/run/session/not_up.hpp"
#include "host/twin/can/client.hpp"

namespace verp::tool {
namespace {

/// A CanBus that allows extra delay for the nodes' answers, and watches its neighbours.
class PatientCan final : public hal::CanBus {
 public:
  PatientCan(link::CanPort& port, const Params& params) : port_(port), neighbours_(params) {}

  bool send(const CanFrame& frame) override {
    neighbours_.sent(frame);
    return port_.send(frame);
  }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    const bool came = port_.poll(frame, timeout_us == 0 ? 0 : timeout_us + held_us_);
    if (came) neighbours_.came(frame);
    return came;
  }
  std::uint64_t now_us() override { return port_.now_us(); }
  hal::CanErrors errors() const override { return port_.errors(); }

  void set_held(std::uint32_t held_us) { held_us_ = held_us; }
  std::string news() { return neighbours_.news(); }

 private:
  link::CanPort& port_;
  CanNeighbours neighbours_;
  std::uint32_t held_us_ = 0;
};

/// CiA 402 drives, with this PC's controller as a node beside them. It takes orders with
/// `--take-orders`, else the program that started the run gives them.
class CanRobot {
  using Ticks = app::TickLog;

 public:
  using Bus = app::OperatorNode;

  CanRobot(link::CanPort& port, const RunPlan& plan)
      : port_(port),
        plan_(plan),
        patient_(port, plan.walk.params),
        registers_(plan.walk.params, setup(plan), ticks_),
        node_(patient_, plan.walk.params, registers_, ticks_) {}

  Bus& bus() { return node_; }
  void set_held(std::uint32_t held_us) { patient_.set_held(held_us); }
  std::string news() { return patient_.news(); }
  void brought_up(const app::BringUpReport& report) { node_.brought_up(report); }
  void record(const TickRecord& tick, const State& state, const Outputs& outputs) {
    node_.record(tick, state, outputs);
  }
  app::OperatorOrder order(std::uint32_t tick) { return node_.order(tick); }
  void report(const app::LoopHealth& health) { node_.report(health); }
  bool connected() const { return port_.connected(); }
  hal::LinkErrors link_errors() const {
    const link::CanTrouble& trouble = port_.trouble();
    return {.overruns = trouble.controller_overruns + trouble.socket_overruns,
            .losses = trouble.losses + trouble.bus_offs};
  }
  static std::string where(std::uint16_t index) { return fmt::format("object {:04X}", index); }

  LetGo let_go(int joint) {
    using canopen::cia402::State;
    namespace object = canopen::cia402::object;
    const std::uint8_t id = plan_.walk.params.joint[joint].servo_id;
    const auto holds = [id](can::Client& client) {
      const auto word = client.read(id, object::kStatusword);
      const State state = canopen::cia402::state_of(static_cast<std::uint16_t>(
          canopen::get_le(word.data(), static_cast<unsigned>(word.size()))));
      return state == State::kOperationEnabled || state == State::kQuickStopActive;
    };
    try {
      can::Client client(port_, plan_.link, kAnswer_us);
      if (!holds(client)) return LetGo::kYes;
      client.write(id, object::kControlword, {0, 0});  // disable voltage
      return holds(client) ? LetGo::kNo : LetGo::kYes;
    } catch (const bus::DeviceError&) {
      return LetGo::kSilent;
    }
  }

 private:
  static app::OperatorSetup setup(const RunPlan& plan) {
    return {.torque_limit_percent = static_cast<std::uint8_t>(plan.torque_percent),
            .takes_orders = plan.takes_orders};
  }

  link::CanPort& port_;
  const RunPlan& plan_;
  PatientCan patient_;
  Ticks ticks_{app::no_images};
  app::OperatorRegisters registers_;
  Bus node_;
};

std::optional<std::uint8_t> somebody(can::Client& client, const Params& params) {
  for (int j = 0; j < params.servo_count() && !cli::interrupted(); ++j) {
    if (client.read_once(params.joint[j].servo_id, canopen::plan::kDeviceType)) {
      return params.joint[j].servo_id;
    }
  }
  return std::nullopt;
}

}  // namespace

void refuse_second_controller(link::CanPort& port, const RunPlan& plan) {
  constexpr std::uint32_t kLook_us = 50'000;
  const std::uint64_t end_ns =
      link::monotonic_ns() + canopen::plan::quiet_us(plan.walk.params) * 1000ull;
  CanFrame frame;
  while (link::monotonic_ns() < end_ns && !cli::interrupted()) {
    if (!port.await(frame, kLook_us) || !canopen::plan::is_of_master(frame)) continue;
    throw session::not_up(
        {.status = app::BringUpStatus::kOccupied, .address = static_cast<std::uint16_t>(frame.id)},
        link::to_text(plan.link), "");
  }
}

bus::LinkFit check_latency(link::CanPort& port, const RunPlan& plan) {
  const Params& params = plan.walk.params;
  can::Client client(port, plan.link, kAnswer_us);
  const std::optional<std::uint8_t> id = somebody(client, params);
  if (!id && !cli::interrupted()) {
    throw cli::ToolError(cli::kNoDevice,
                         fmt::format("{}: no drive of {} answers; check power, wiring, "
                                     "termination and bit rate, see `verp bus scan`",
                                     client.place(), params.name));
  }
  bus::LinkFit fit;
  fit.period_us = params.period_us;
  fit.wire_us = canopen::plan::tick_us(params);
  fit.reads = canopen::plan::sync_groups(params);
  if (id) {
    fit.delay =
        bus::measure_delay([&] { return client.read_once(*id, canopen::plan::kDeviceType); },
                           app::can_frames_us(canopen::sdo::kFrameBytes, 2, params.baud),
                           [] { return cli::interrupted(); });
  }
  judge_fit(fit, plan);
  return fit;
}

void check_imu(link::CanPort& port, const RunPlan& plan) {
  if (!plan.has_imu || plan.own_imu != nullptr) return;
  judge_imu(plan, "");
  can::Client client(port, plan.link, kAnswer_us);
  const auto found = client.identify(plan.walk.params.imu.device_id);
  if (found && found->product == dxl::kModelImu) return;
  if (!found) return judge_imu(plan, "does not answer");
  if (found->asked != can::NodeIdentity::Asked::kToTheEnd) {
    return judge_imu(plan, "fell silent while it was asked what it is");
  }
  judge_imu(plan, found->product ? fmt::format("has product code 0x{:X}, not 0x{:X}",
                                               *found->product, dxl::kModelImu)
                                 : "tells no product code");
}

RunResult drive(link::CanPort& port, const RunPlan& plan, const bus::LinkFit& fit,
                record::TraceWriter* trace, cli::Progress& progress) {
  CanRobot robot(port, plan);
  return RobotRun<CanRobot>(robot, plan, fit, trace, progress).run();
}

}  // namespace verp::tool
