#include "host/tool/run_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "firmware/app/app.hpp"
#include "firmware/app/link_bus.hpp"
#include "host/bus/assumed_imu.hpp"
#include "host/bus/register_names.hpp"
#include "host/link/system_clock.hpp"
#include "host/record/trace_error.hpp"
#include "host/tool/console.hpp"
#include "host/tool/exit_status.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/run_operator.hpp"

namespace verp::tool {
namespace {

constexpr std::uint32_t kAnswer_us = 100'000;  // the slowest adapter known holds bytes for 16 ms

[[noreturn]] void not_up(const app::BringUpReport& report, const std::string& place) {
  const std::string at = fmt::format("{}: device {} ", place, report.device_id);
  switch (report.status) {
    case app::BringUpStatus::kWrongModel:
      throw ToolError(
          kNoDevice,
          fmt::format("{}is a {}, the model says {}; correct the model's type or the "
                      "servo's id (`verp bus setup`)",
                      at, bus::model_name(report.found), bus::model_name(report.expected)));
    case app::BringUpStatus::kRefused:
      throw ToolError(kNoDevice, fmt::format("{}refuses register {}; reboot it, or see its "
                                             "hardware error: `verp bus read --id {}`",
                                             at, report.address, report.device_id));
    case app::BringUpStatus::kNotVerified:
      throw ToolError(kNoDevice, fmt::format("{}does not keep what is written to register {}; is "
                                             "another program using this bus?",
                                             at, report.address));
    case app::BringUpStatus::kHardwareError:
      throw ToolError(kNoDevice,
                      fmt::format("{}has a hardware error ({}) and may be limp; cure it, then "
                                  "switch the servo off and on, which clears it",
                                  at, bus::hardware_errors(report.found)));
    default:
      throw ToolError(kNoDevice, fmt::format("{}does not answer; check power, wiring and ids "
                                             "(`verp bus scan`, `verp bus setup`)",
                                             at));
  }
}

/// Recorder of a run: passes each tick to the operator, the trace and the result.
struct Keeper {
  void record(const TickRecord& tick, const State& state, const Outputs& outputs) {
    person.observe(state, outputs);
    ++walk.ticks;
    walk.digest = tick.digest.chain;
    walk.faults |= outputs.faults;
    if (trace == nullptr) return;
    try {
      trace->append(tick, state, outputs.faults);
    } catch (const record::TraceError& error) {  // a disk that is full costs the trace
      walk.trace_failure = error.what();
      trace = nullptr;
    }
  }
  RunOperator& person;
  WalkResult& walk;
  record::TraceWriter* trace;
};

/// One robot, driven in real time.
class RobotRun {
 public:
  RobotRun(wire::Link& link, const RunPlan& plan, const bus::LinkFit& fit,
           record::TraceWriter* trace, Progress& progress)
      : link_(link),
        plan_(plan),
        params_(plan.walk.params),
        progress_(progress),
        bus_(link_, clock_, kAnswer_us),
        imu_(params_.imu),
        operator_(params_, plan.walk.velocity, plan.walk.walk_s,
                  [this](auto from, auto to, auto faults) { tell(from, to, faults); }),
        keeper_{operator_, result_.walk, trace},
        app_(params_, bus_, operator_, keeper_, plan.has_imu ? nullptr : &imu_) {
    result_.fit = fit;
  }

  RunResult run() {
    const app::BringUpReport report = app_.bring_up();
    if (report.status != app::BringUpStatus::kReady) not_up(report, place());
    app_.limit_torque(static_cast<std::uint8_t>(plan_.torque_percent));
    bus_.set_held(result_.fit.held_us());  // nobody waited for the bring-up
    result_.real_time = become_real_time();
    if (!result_.real_time.advice.empty()) say(result_.real_time.advice);
    const std::uint64_t start_ns = wire::monotonic_ns();
    loop();
    result_.walk.wall_s = 1e-9 * static_cast<double>(wire::monotonic_ns() - start_ns);
    progress_.clear();
    make_sure();
    finish();
    return std::move(result_);
  }

 private:
  using Bus = app::LinkBus<wire::Link, wire::SystemClock>;
  using Loop = app::App<Bus, RunOperator, Keeper, bus::AssumedImu>;

  std::string place() const { return wire::to_text(plan_.link); }

  void say(const std::string& line) {
    progress_.clear();
    complain("verp run: " + line);
  }

  void loop() {
    app::Pacer pacer(clock_);
    pacer.start(params_.period_us);
    while (!operator_.over() || result_.walk.ticks == 0) {
      app_.tick(pacer.next());
      watch_link();
      watch_person();
      progress_.show(
          operator_.walked_s() / plan_.walk.walk_s,
          fmt::format("{}  {:.1f} of {:g} s, {} deadlines missed", params_.name,
                      operator_.walked_s(), plan_.walk.walk_s, pacer.deadlines().missed));
    }
    result_.deadlines = pacer.deadlines();
  }

  void watch_person() {
    const int presses = tool::presses();
    if (presses == presses_) return;
    presses_ = presses;
    if (presses == 1) {
      say("interrupted: the robot sits down, then lets go; once more lets go at once");
      operator_.sit_down();
    } else {
      say("torque off at once");
      operator_.let_go();
    }
  }

  void watch_link() {
    if (link_.connected() == connected_) return;
    connected_ = link_.connected();
    say(connected_ ? "the link is back"
                   : place() +
                         ": the link is lost: the robot holds, then sits and lets go; the "
                         "same port is tried again");
  }

  void tell(safety::Mode from, safety::Mode to, std::uint32_t faults) {
    const std::string why = fault_names(faults & 0xFFFF);  // the lower half stops the robot
    say(fmt::format("{} to {}{}", safety::kModeNames[static_cast<int>(from)],
                    safety::kModeNames[static_cast<int>(to)], why.empty() ? "" : " (" + why + ")"));
  }

  // Torque Enable is sent to all and answered by nobody: so each servo is asked.
  void make_sure() {
    for (int j = 0; j < params_.joint_count; ++j) {
      try {
        bus::Client client(link_, plan_.link, kAnswer_us);
        const std::uint8_t id = params_.joint[j].servo_id;
        if (!link_.connected()) throw bus::DeviceError("gone");
        if (client.read(id, dxl::address::kTorqueEnable, 1)[0] == 0) continue;
        client.write(id, dxl::address::kTorqueEnable, {0});
        result_.stiff_servos += client.read(id, dxl::address::kTorqueEnable, 1)[0] == 0 ? 0 : 1;
      } catch (const bus::DeviceError&) {
        ++result_.silent_servos;
        if (!link_.connected()) {  // nobody else will answer either
          result_.silent_servos += params_.joint_count - j - 1;
          break;
        }
      }
    }
    if (result_.silent_servos + result_.stiff_servos == 0) return;
    say(fmt::format("{} servos did not say that they let go: switch their power off",
                    result_.silent_servos + result_.stiff_servos));
  }

  void finish() {
    WalkResult& walk = result_.walk;
    walk.interrupted = interrupted();
    walk.simulated_s = 1e-6 * static_cast<double>(params_.period_us) *
                       static_cast<double>(result_.deadlines.ticks + result_.deadlines.skipped);
    walk.failure = operator_.failure();
    result_.walked_s = operator_.walked_s();
    result_.bus = app_.counters();
    result_.crc_errors = app_.crc_errors();
    result_.link = link_.errors();
    result_.device_trouble = result_.silent_servos > 0 || !link_.connected();
    if (walk.failure.empty() && result_.silent_servos + result_.stiff_servos > 0) {
      walk.failure = "not every servo let go";
    }
  }

  wire::Link& link_;
  const RunPlan& plan_;
  const Params& params_;
  Progress& progress_;
  wire::SystemClock clock_;
  Bus bus_;
  bus::AssumedImu imu_;
  RunResult result_;
  RunOperator operator_;
  Keeper keeper_;
  Loop app_;
  bool connected_ = true;
  int presses_ = 0;
};

}  // namespace

bus::LinkFit check_latency(wire::Link& link, const RunPlan& plan) {
  const Params& params = plan.walk.params;
  bus::Client client(link, plan.link, kAnswer_us);
  const bus::LinkFit fit =
      bus::fit(params, bus::measure_delay(client, params, [] { return interrupted(); }));
  const std::string numbers = fmt::format(
      "{}: a read is held up for {:.1f} ms (median of {}, slowest tenth {:.1f}): two of them and "
      "{:.1f} ms on the wire take {:.1f} of a period of {:g} ms",
      wire::to_text(plan.link), 1e-3 * fit.delay.median_us, fit.delay.answered,
      1e-3 * fit.delay.p90_us, 1e-3 * fit.wire_us, 1e-3 * fit.needed_us(), 1e-3 * fit.period_us);
  if (interrupted()) throw ToolError(kRunFailed, "verp run: interrupted; torque was never on");
  if (!fit.fits()) {
    throw ToolError(kNoDevice, numbers + "; " + bus::remedy(fit, params, plan.link));
  }
  if (!fit.fits_well()) {
    complain("verp run: " + numbers +
             "; some deadlines will be missed: " + bus::remedy(fit, params, plan.link));
  }
  return fit;
}

void check_imu(wire::Link& link, const RunPlan& plan) {
  if (!plan.has_imu) return;
  constexpr const char* kRemedy =
      "without one there is no balance, and nobody notices a fall; --imu none walks all the same, "
      "on level ground, with balance off";
  const int id = plan.walk.params.imu.device_id;
  if (id == 0) {
    throw ToolError(kNoDevice, fmt::format("verp run: {} names no IMU on the servo bus: {}",
                                           plan.walk.params.name, kRemedy));
  }
  bus::Client client(link, plan.link, kAnswer_us);
  const auto found = client.ping(static_cast<std::uint8_t>(id));
  if (found && found->model == dxl::kModelImu) return;
  throw ToolError(
      kNoDevice,
      fmt::format("{}: the IMU (device {}) {}: {}", wire::to_text(plan.link), id,
                  found ? "is a " + bus::model_name(found->model) : "does not answer", kRemedy));
}

RunResult drive(wire::Link& link, const RunPlan& plan, const bus::LinkFit& fit,
                record::TraceWriter* trace, Progress& progress) {
  return RobotRun(link, plan, fit, trace, progress).run();
}

}  // namespace verp::tool
