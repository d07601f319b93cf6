#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "firmware/app/app.hpp"
#include "firmware/app/pacer.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/tool/robot/run_operator.hpp"
#include "host/apps/tool/robot/run_robot.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/run/session/fault_names.hpp"
#include "host/run/session/not_up.hpp"
#include "host/run/session/suspicions.hpp"
#include "host/trace/record/trace_error.hpp"
#include "host/twin/bus/assumed_imu.hpp"

namespace verp::tool {

/// The slowest known adapter holds received bytes for 16 ms.
inline constexpr std::uint32_t kAnswer_us = 100'000;
inline constexpr int kAsked = 3;  ///< requests to a silent servo for its torque state

/// Answer at the end: is the servo's torque off?
enum class LetGo : std::uint8_t { kYes, kNo, kSilent };

/// Throws ToolError with the remedy if a tick cannot fit; warns if it barely fits.
void judge_fit(const bus::LinkFit& fit, const RunPlan& plan);
/// Throws ToolError without an IMU on the bus, or if `trouble` is not empty.
void judge_imu(const RunPlan& plan, const std::string& trouble);

/// The IMU of this PC, or an assumed one.
struct RunImu {
  hal::ImuStatus read(hal::ImuSample& sample) {
    return own == nullptr ? assumed.read(sample) : own->read(sample);
  }
  std::uint32_t faults() const { return own == nullptr ? 0 : own->faults(); }
  imu::ImuPort* own;
  bus::AssumedImu assumed;
};

template <class Robot>
struct RunKeeper {
  void record(const TickRecord& tick, const State& state, const Outputs& outputs) {
    robot.record(tick, state, outputs);  // before a slow disk
    person.observe(state, outputs);
    suspicions.tick(params, tick.inputs, state);
    ++walk.ticks;
    walk.digest = tick.digest.chain;
    walk.faults |= outputs.faults;
    if (trace == nullptr) return;
    try {
      trace->append(tick, state, outputs);
    } catch (const record::TraceError& error) {  // a full disk ends only the trace
      walk.trace_failure = error.what();
      trace = nullptr;
    }
  }
  Robot& robot;
  RunOperator& person;
  WalkResult& walk;
  record::TraceWriter* trace;
  const Params& params;
  session::Suspicions suspicions = {};
};

/// Drives one robot in real time, or in a twin's time. Robot is the access to it:
///  - Bus, bus(): the bus for App, with the delays of bring-up until set_held(us) sets the longest
///  delay of answers;
///  - connected(), link_errors(); let_go(joint): asks one servo and repeats the release;
///  - brought_up(report), record(...) as a Recorder, report(health) after each tick: for observers
///    on the bus;
///  - stopped(), only for a twin in lockstep: it takes no further tick, and the run has no pace;
///  - news(), if it hears its neighbours on the bus: a line for the user, or empty;
///  - order(tick), as an OperatorLink, if others on the bus may give orders;
///  - where(address): the place of a failed bring-up.
template <class Robot>
class RobotRun {
 public:
  RobotRun(Robot& robot, const RunPlan& plan, const bus::LinkFit& fit, record::TraceWriter* trace,
           cli::Progress& progress)
      : robot_(robot),
        plan_(plan),
        params_(plan.walk.params),
        progress_(progress),
        imu_{plan.own_imu, bus::AssumedImu(params_.imu)},
        operator_(
            params_, plan.walk.velocity, plan.walk.walk_s,
            [this](auto from, auto to, auto faults, const std::string& story,
                   const std::string& silent) { tell(from, to, faults, story, silent); },
            plan.walk.get_ups, plan.walk.stands),
        keeper_{robot_, operator_, result_.walk, trace, params_},
        app_(params_, robot_.bus(), operator_, keeper_,
             plan.has_imu && plan.own_imu == nullptr ? nullptr : &imu_,
             app::Core{{plan.walk.actions.data(), 4 * plan.walk.actions.size()}}) {
    result_.fit = fit;
    if (plan.action != 0) operator_.play(plan.action);
    if (plan.stop != nullptr) operator_.stop_at(*plan.stop);
    if constexpr (requires { robot.order(0u); }) {
      if (plan.takes_orders) operator_.obey([this](auto tick) { return robot_.order(tick); });
    }
  }

  RunResult run() {
    const app::BringUpReport report = app_.bring_up();
    robot_.brought_up(report);
    if (report.status != app::BringUpStatus::kReady)
      throw session::not_up(report, place(), Robot::where(report.address));
    app_.limit_torque(static_cast<std::uint8_t>(plan_.torque_percent));
    robot_.set_held(result_.fit.held_us());  // bring-up has its own limits
    if constexpr (!kInLockstep) result_.real_time = cli::become_real_time();
    if (!result_.real_time.advice.empty()) say(result_.real_time.advice);
    const std::uint64_t start_ns = link::monotonic_ns();
    loop();
    result_.walk.wall_s = 1e-9 * static_cast<double>(link::monotonic_ns() - start_ns);
    progress_.clear();
    make_sure();
    finish();
    return std::move(result_);
  }

 private:
  static constexpr bool kInLockstep = requires(Robot & robot) { robot.stopped(); };
  using Loop = app::App<typename Robot::Bus, RunOperator, RunKeeper<Robot>, RunImu>;

  std::string place() const { return link::to_text(plan_.link); }

  void say(const std::string& line) {
    progress_.clear();
    cli::complain("verp run: " + line);
  }

  void loop() {
    app::Pacer pacer(clock_);
    pacer.start(params_.period_us);
    while (!operator_.over() || result_.walk.ticks == 0) {
      app_.tick(kInLockstep ? app::Beat{} : pacer.next());
      if (twin_ended()) break;
      report(pacer.deadlines());
      watch_link();
      watch_imu();
      watch_person();
      watch_plan();
      progress_.show(
          operator_.walked_s() / plan_.walk.walk_s,
          fmt::format(
              "{}  {}{}", params_.name, so_far(),
              kInLockstep ? "" : fmt::format(", {} deadlines missed", pacer.deadlines().missed)));
    }
    result_.deadlines = pacer.deadlines();
  }

  std::string so_far() const {
    if (plan_.action != 0) return fmt::format("acting for {:.1f} s", operator_.played_s());
    return fmt::format("{:.1f} of {:g} s", operator_.walked_s(), plan_.walk.walk_s);
  }

  /// The twin's run may end before its controller's.
  bool twin_ended() const {
    if constexpr (kInLockstep) return robot_.stopped();
    return false;
  }

  void report(const app::Deadlines& deadlines) {
    robot_.report({.bus = app_.counters(),
                   .bus_crc_errors = app_.crc_errors(),
                   .bus_noise_bytes = app_.noise_bytes(),
                   .skipped_periods = static_cast<std::uint32_t>(deadlines.skipped),
                   .efforts = app_.efforts()});
  }

  void watch_person() {
    const int presses = cli::presses();
    if (presses == presses_) return;
    presses_ = presses;
    if (presses == 1) {
      say("interrupted: the robot sits down, lies down if it can, then lets go; once more lets "
          "go at once");
      operator_.sit_down();
    } else {
      say("torque off at once");
      operator_.let_go();
    }
  }

  void watch_link() {
    if (robot_.connected() == connected_) return;
    connected_ = robot_.connected();
    say(connected_ ? "the link is back"
                   : place() +
                         ": the link is lost: the robot holds, then sits and lets go; the "
                         "same port is tried again");
  }

  /// Names an IMU of this PC: the controller knows only that it is silent.
  void watch_imu() {
    if (plan_.own_imu == nullptr) return;
    const bool fresh = (app_.inputs().flags & kImuFresh) != 0;
    imu_silent_us_ = fresh ? 0 : imu_silent_us_ + params_.period_us;
    const bool silent = imu_silent_us_ >= kImuSilence_us;
    if (silent == imu_silent_) return;
    imu_silent_ = silent;
    say(silent ? plan_.imu_name +
                     ": the IMU is silent: the robot holds, then sits and lets go; the same chip "
                     "is tried again"
               : plan_.imu_name + ": the IMU is back");
  }

  void watch_plan() {
    const std::string news = plan_notes_.news(app_.outputs().faults);
    if (!news.empty()) say(news);
    if constexpr (requires { robot_.news(); }) {
      if (const std::string heard = robot_.news(); !heard.empty()) say(heard);
    }
  }

  void tell(safety::Mode from, safety::Mode to, std::uint32_t faults, const std::string& story,
            const std::string& silent) {
    std::string why = session::fault_names(faults & 0xFFFF);  // faults that stop the robot
    if (!silent.empty() && !why.empty()) why += ": " + silent;
    say(fmt::format("{} to {}{}{}", safety::kModeNames[static_cast<int>(from)],
                    safety::kModeNames[static_cast<int>(to)], why.empty() ? "" : " (" + why + ")",
                    story.empty() ? "" : ": " + story));
    if (story.empty()) return;
    const double at_s = 1e-6 * params_.period_us * static_cast<double>(result_.walk.ticks);
    result_.walk.fall_story.push_back({at_s, story});
  }

  // Asks each servo whether it released torque, because the release is a broadcast without answers.
  // Repeats: the wire may lose a frame, a busy PC may read too late. A second Ctrl-C ends this.
  void make_sure() {
    if (twin_ended()) return;  // no torque either
    std::vector<int> silent(static_cast<std::size_t>(params_.servo_count()));
    std::iota(silent.begin(), silent.end(), 0);
    for (int round = 0; round < kAsked && !silent.empty(); ++round) {
      std::erase_if(silent, [this](int joint) {
        const bool asks = robot_.connected() && cli::presses() == presses_;
        const LetGo said = asks ? robot_.let_go(joint) : LetGo::kSilent;
        result_.stiff_servos += said == LetGo::kNo ? 1 : 0;
        return said != LetGo::kSilent;
      });
    }
    result_.silent_servos = static_cast<int>(silent.size());
    if (result_.silent_servos + result_.stiff_servos == 0) return;
    say(fmt::format("{} servos did not say that they let go: switch their power off",
                    result_.silent_servos + result_.stiff_servos));
  }

  void finish() {
    constexpr double kGravity_m_s2 = 9.81;
    const std::string doubt = keeper_.suspicions.text(kGravity_m_s2, true);
    if (!doubt.empty()) say(doubt);
    WalkResult& walk = result_.walk;
    walk.interrupted = cli::interrupted();
    walk.simulated_s = 1e-6 * static_cast<double>(params_.period_us) *
                       static_cast<double>(result_.deadlines.ticks + result_.deadlines.skipped);
    walk.failure = operator_.failure();
    result_.ended = plan_.has_imu ? operator_.ended() : "unknown: no IMU";
    walk.falls = operator_.falls();
    walk.get_ups = operator_.get_ups();
    if (imu_silent_ && !walk.failure.empty()) {
      walk.failure += "; " + plan_.imu_name + " is silent: check its cable and its supply";
    }
    if (walk.failure.empty() && !operator_.over()) walk.failure = "the twin's run ended before";
    if constexpr (kInLockstep)
      walk.simulated_s = 1e-6 * params_.period_us * static_cast<double>(walk.ticks);
    result_.walked_s = operator_.walked_s();
    result_.played_s = operator_.played_s();
    result_.bus = app_.counters();
    result_.crc_errors = app_.crc_errors();
    result_.link = robot_.link_errors();
    result_.device_trouble = result_.silent_servos > 0 || !robot_.connected() || imu_silent_;
    if (walk.failure.empty() && result_.silent_servos + result_.stiff_servos > 0) {
      walk.failure = "not every servo let go";
    }
  }

  Robot& robot_;
  const RunPlan& plan_;
  const Params& params_;
  cli::Progress& progress_;
  link::SystemClock clock_;
  RunImu imu_;
  RunResult result_;
  RunOperator operator_;
  RunKeeper<Robot> keeper_;
  Loop app_;
  session::PlanNotes plan_notes_;
  static constexpr std::uint32_t kImuSilence_us = 40'000;  ///< before it holds (stale_hold_s)
  std::uint32_t imu_silent_us_ = 0;
  bool imu_silent_ = false;
  bool connected_ = true;
  int presses_ = 0;
};

}  // namespace verp::tool
