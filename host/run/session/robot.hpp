#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "firmware/app/contracts.hpp"
#include "host/run/session/estimate_meter.hpp"
#include "host/run/session/fall_story.hpp"
#include "host/run/session/fall_verdict.hpp"
#include "host/run/session/plan.hpp"
#include "host/run/session/strain.hpp"
#include "host/run/session/suspicions.hpp"
#include "host/run/session/walk_operator.hpp"
#include "host/twin/bus/virtual_bus.hpp"
#include "host/twin/can/virtual_can.hpp"

namespace verp::session {

/// A session's robot without its controller: twin, bus, operator, meter and trace. It is the
/// controller's OperatorLink and Recorder.
class Robot {
 public:
  using Interrupted = std::function<bool()>;

  /// The world must outlive the robot.
  Robot(sim::World& world, const WalkPlan& plan, Hooks hooks, Interrupted interrupted);

  const WalkPlan& plan() const { return plan_; }
  const action::Library& actions() const { return actions_; }
  std::string name() const { return plan_.name.empty() ? plan_.params.name : plan_.name; }
  sim::TwinRobot& twin() { return twin_; }
  /// Only the bus of the plan's Params exists.
  bus::VirtualBus& bus() { return *bus_; }
  can::VirtualCan& can() { return *can_; }
  /// Between controller and bus(), if the plan's fault spoils the line; else null.
  bus::FaultyLine* line() { return line_ ? &*line_ : nullptr; }

  bool ticking() const { return can_ ? can_->ticking() : bus_->ticking(); }
  /// Advances time; discards what the bus receives meanwhile.
  void let_pass(std::uint32_t time_us);

  app::OperatorOrder order(std::uint32_t tick);
  /// Computes a tick in this process.
  void decide(State& state, const Inputs& inputs, Outputs& outputs);
  /// The controller restarted: stand up and walk for the remaining time. The trace ends, because
  /// its ticks must follow each other.
  void begin_anew();
  /// The walk ended, failed or was interrupted.
  bool over() const;
  bool interrupted() const { return interrupted_ && interrupted_(); }
  /// Ends the run for a reason outside the walk. The first reason counts.
  void fail(const std::string& why);

  /// take() stores a controller's tick. see() passes it to meter, trace and hooks, once.
  void take(const TickRecord& tick, const State& state, const Outputs& outputs);
  void see();
  void record(const TickRecord& tick, const State& state, const Outputs& outputs) {
    take(tick, state, outputs);
    see();
  }
  /// One tick without reports. The run lasts plan.walk_s from the first torque on; a scan for
  /// servos does not start it. A fall ends it early unless plan.get_ups allows recovery. Lying down
  /// without torque is no fall (FallVerdict).
  void watch();

  /// Sets the source of the world's quantities; call it before the first tick.
  void set_quantities(std::function<sim::Quantities&()> quantities) {
    quantities_ = std::move(quantities);
  }
  /// Acts after the last tick and is recorded. Throws std::invalid_argument, without effect, for an
  /// unknown name or a value out of range.
  void intervene(const Intervention& intervention);

  /// The user sets it upright (sim::TwinRobot); the result keeps the time. False: a servo has
  /// torque.
  bool set_upright();

  std::uint32_t tick() const { return tick_.inputs.tick; }
  double simulated_s() const;
  bool has_torque();
  double gone_s() const;
  bool fallen() const { return twin_.fallen(); }
  const FallVerdict& verdict() const { return verdict_; }

  /// Call once.
  WalkResult result(double wall_s);

 private:
  void append(const sim::Truth& truth, const std::vector<sim::Scan>& scans);
  void append(const sim::Scan& scan);
  void tell(const std::vector<sim::Scan>& scans) const;
  void tell_exposures();
  std::string culprit(const sim::Truth& truth) const;
  std::string failure_of_walk() const;
  std::string why_it_failed() const;
  void intervene_in_time();
  void go_wrong();
  void note(const std::string& what);
  void look_after_falls();
  void tell(const std::string& news);
  void count_traffic();
  double furthest_from_goal_rad(const sim::Truth& truth);
  double walked_s() const;

  const WalkPlan plan_;
  const action::Library actions_{plan_.actions.data(), 4 * plan_.actions.size()};
  const Hooks hooks_;
  const Interrupted interrupted_;
  record::TraceWriter* trace_;
  const sim::World& world_;
  sim::TwinRobot twin_;
  std::optional<bus::VirtualBus> bus_;
  std::optional<can::VirtualCan> can_;
  std::optional<bus::FaultyLine> line_;
  bool wrong_ = false;  ///< the plan's fault has begun
  std::optional<WalkOperator> walker_;
  double walked_s_ = 0;  ///< before a restart
  sim::WalkMeter meter_;
  EstimateMeter estimate_meter_;
  WalkResult result_;
  std::function<sim::Quantities&()> quantities_;
  std::deque<Intervention> pending_;  ///< in order of time
  TickRecord tick_;                   ///< with state_ and outputs_
  State state_;
  Outputs outputs_;
  FallStory story_;
  Suspicions suspicions_;
  std::string culprit_;  ///< of the first fault
  Strain strain_;
  std::uint64_t late_ticks_ = 0;
  bool taken_ = false;                                    ///< take() was called, but see() not yet
  std::uint64_t bits_before_ = 0, bare_bits_before_ = 0;  ///< at the first tick
  FallVerdict verdict_;
  Descent descent_;
  double begun_s_ = 0;  ///< simulated time of the first tick or torque
  double after_s_ = 0;
  bool over_ = false;
  bool watched_ = false;
  bool lies_ = false;  ///< watch() reported that it lies
};

}  // namespace verp::session
