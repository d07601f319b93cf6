#include "host/apps/tool/robot/run_robot.hpp"

#include <fmt/format.h>

#include "common/protocol/feetech_table.hpp"
#include "firmware/app/link_bus.hpp"
#include "firmware/app/tick_report.hpp"
#include "host/apps/tool/robot/robot_loop.hpp"
#include "host/twin/bus/register_names.hpp"

namespace verp::tool {
namespace {

class SerialRobot {
 public:
  using Bus = app::LinkBus<link::Link, link::SystemClock>;

  SerialRobot(link::Link& link, const RunPlan& plan)
      : link_(link), plan_(plan), bus_(link_, clock_, kAnswer_us) {}

  Bus& bus() { return bus_; }
  void set_held(std::uint32_t held_us) { bus_.set_held(held_us); }
  bool connected() const { return link_.connected(); }
  hal::LinkErrors link_errors() const { return link_.errors(); }
  static std::string where(std::uint16_t address) { return fmt::format("register {}", address); }

  // No other device here can query the master.
  void brought_up(const app::BringUpReport&) {}
  void record(const TickRecord&, const State&, const Outputs&) {}
  void report(const app::LoopHealth&) {}

  LetGo let_go(int joint) {
    const std::uint8_t id = plan_.walk.params.joint[joint].servo_id;
    const BusProtocol protocol = plan_.walk.params.bus_protocol;
    const std::uint16_t torque = protocol == BusProtocol::kFeetech
                                     ? std::uint16_t{feetech::address::kTorqueEnable}
                                     : dxl::address::kTorqueEnable;
    const auto holds = [=](bus::Client& client) { return client.read(id, torque, 1)[0] != 0; };
    try {
      bus::Client client(link_, plan_.link, kAnswer_us, protocol);
      if (!holds(client)) return LetGo::kYes;
      client.write(id, torque, {0});
      return holds(client) ? LetGo::kNo : LetGo::kYes;
    } catch (const bus::DeviceError&) {
      return LetGo::kSilent;
    }
  }

 private:
  link::Link& link_;
  const RunPlan& plan_;
  link::SystemClock clock_;
  Bus bus_;
};

}  // namespace

bus::LinkFit check_latency(link::Link& link, const RunPlan& plan) {
  const Params& params = plan.walk.params;
  bus::Client client(link, plan.link, kAnswer_us, plan.walk.params.bus_protocol);
  const bus::LinkFit fit =
      bus::fit(params, bus::measure_delay(client, params, [] { return cli::interrupted(); }));
  judge_fit(fit, plan);
  return fit;
}

void check_imu(link::Link& link, const RunPlan& plan) {
  if (!plan.has_imu || plan.own_imu != nullptr) return;
  judge_imu(plan, "");
  bus::Client client(link, plan.link, kAnswer_us, plan.walk.params.bus_protocol);
  const auto found = client.ping(plan.walk.params.imu.device_id);
  if (found && found->model == dxl::kModelImu) return;
  judge_imu(plan,
            found ? "is a " + bus::model_name(found->model, client.protocol()) : "does not answer");
}

RunResult drive(link::Link& link, const RunPlan& plan, const bus::LinkFit& fit,
                record::TraceWriter* trace, cli::Progress& progress) {
  SerialRobot robot(link, plan);
  return RobotRun<SerialRobot>(robot, plan, fit, trace, progress).run();
}

}  // namespace verp::tool
