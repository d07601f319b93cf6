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
#include "host/run/session/walk_operator.hpp"
#include "host/twin/bus/virtual_bus.hpp"
#include "host/twin/can/virtual_can.hpp"

namespace verp::session {

/// One robot of a session: its twin, bus, operator, meter and trace; the controller is somewhere
/// else. An OperatorLink and a Recorder for it.
class Robot {
 public:
  using Interrupted = std::function<bool()>;

  /// The world must outlive the robot.
  Robot(sim::World& world, const WalkPlan& plan, Hooks hooks, Interrupted interrupted);

  const WalkPlan& plan() const { return plan_; }
  /// Of the plan: what may be asked for by its number.
  const action::Library& actions() const { return actions_; }
  std::string name() const { return plan_.name.empty() ? plan_.params.name : plan_.name; }
  sim::TwinRobot& twin() { return twin_; }
  /// The bus that the plan's Params speak of; the other one is not there.
  bus::VirtualBus& bus() { return *bus_; }
  can::VirtualCan& can() { return *can_; }

  /// Its bus has begun to tick.
  bool ticking() const { return can_ ? can_->ticking() : bus_->ticking(); }
  /// Lets time go on by so much; what its bus brings meanwhile, nobody hears.
  void let_pass(std::uint32_t time_us);

  /// What the person who gives orders wants in this tick.
  app::OperatorOrder order(std::uint32_t tick);
  /// The tick of a controller in this process.
  void decide(State& state, const Inputs& inputs, Outputs& outputs);
  /// The controller began anew, on the robot as it is: the operator has it stand up and walk for
  /// what is left of the time. The trace ends before: a tick has no other one to follow there.
  void begin_anew();
  /// The walk has ended, went wrong besides, or somebody interrupts.
  bool over() const;
  bool interrupted() const { return interrupted_ && interrupted_(); }
  /// Something went wrong besides the walk, which is over: why. The first reason stands.
  void fail(const std::string& why);

  /// A tick of the controller, wherever it ran: take() keeps it, see() has the meter, the trace and
  /// the hooks look at it, if they have not.
  void take(const TickRecord& tick, const State& state, const Outputs& outputs);
  void see();
  void record(const TickRecord& tick, const State& state, const Outputs& outputs) {
    take(tick, state, outputs);
    see();
  }
  /// A tick of a controller that tells nothing of itself: only what the twin did is scored. The
  /// run begins when a servo first has torque, not when somebody looks for servos, and has
  /// plan.walk_s from then on. It ends sooner if the robot falls and may not get up (plan.get_ups);
  /// one that is let go may lie down (FallVerdict), and is served on.
  void watch();

  /// Who gives the world's quantities and pushes; before the first tick.
  void set_quantities(std::function<sim::Quantities&()> quantities) {
    quantities_ = std::move(quantities);
  }
  /// Done now, after the last tick, and recorded. Throws std::invalid_argument if there is nothing
  /// of that name, or the value is out of range: nothing was done then.
  void intervene(const Intervention& intervention);

  /// Somebody sets it on its feet (sim::TwinRobot): kept in the result, with the time. False: not
  /// now, a servo has torque.
  bool set_upright();

  /// Number of the last tick of its controller.
  std::uint32_t tick() const { return tick_.inputs.tick; }
  double simulated_s() const;
  /// Any servo of it.
  bool has_torque();
  /// How much of plan.walk_s has gone by.
  double gone_s() const;
  bool fallen() const { return twin_.fallen(); }
  /// Of what was watched.
  const FallVerdict& verdict() const { return verdict_; }

  /// Once, at the end.
  WalkResult result(double wall_s);

 private:
  void append(const sim::Truth& truth, const std::vector<sim::Scan>& scans);
  void append(const sim::Scan& scan);
  void tell(const std::vector<sim::Scan>& scans) const;
  void tell_exposures();
  std::string failure_of_walk() const;
  void intervene_in_time();
  void note(const std::string& what);
  void look_after_falls();
  void tell(const std::string& news);
  void count_traffic();
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
  std::optional<WalkOperator> walker_;
  double walked_s_ = 0;  ///< by controllers that are no more
  sim::WalkMeter meter_;
  EstimateMeter estimate_meter_;
  WalkResult result_;
  std::function<sim::Quantities&()> quantities_;
  std::deque<Intervention> pending_;  ///< the next one first
  TickRecord tick_;                   ///< the last one taken, and what came with it
  State state_;
  Outputs outputs_;
  FallStory story_;
  bool taken_ = false;                                    ///< and not seen yet
  std::uint64_t bits_before_ = 0, bare_bits_before_ = 0;  ///< the first tick
  FallVerdict verdict_;
  double begun_s_ = 0;  ///< when the first tick was over or torque was first seen, simulated time
  double after_s_ = 0;
  bool over_ = false;
  bool watched_ = false;
  bool lies_ = false;  ///< of one that is watched: it was told
};

}  // namespace verp::session
