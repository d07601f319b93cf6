#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "host/run/session/controller.hpp"
#include "host/run/session/plan.hpp"
#include "host/run/session/robot.hpp"
#include "host/twin/sim/quantities.hpp"
#include "host/twin/sim/scenery.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::session {

struct Options {
  sim::WorldOptions world = {};
  std::function<bool()> interrupted;  ///< polled at each tick; true ends the run
};

/// Two robots would start in the same place.
class NoRoom : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A world and the robots in it, tick by tick:
///
///     Session session;
///     session.add(plan);
///     while (session.tick()) {
///     }
///     const WalkResult result = session.result(0);
///
/// One simulation step advances all robots. Each robot's bus requests a time and waits until the
/// world reaches it. The world advances when every other bus has requested a time at least as late,
/// so no robot sees or acts in another robot's past. Deterministic: equal plans in equal order give
/// equal bits, whatever the timing of the calls. The run pauses while the caller does not call
/// tick(). Errors are exceptions with text; they end the run of the robot that caused them.
class Session {
 public:
  explicit Session(Options options = {});
  ~Session();

  /// Adds a robot; only before the first tick. Throws NoRoom if another robot starts less than
  /// 0.1 m away, and what TwinRobot's constructor and `make` throw.
  Robot& add(const WalkPlan& plan, Hooks hooks = {}, const MakeController& make = make_controller);

  /// Advances until one robot has done a control tick, or its controller has kept the session
  /// waiting for some ms. Returns that robot; null: the run is over.
  Robot* tick();
  /// Why the physics diverged, which ends the run of every robot; empty: they did not diverge.
  const std::string& diverged() const { return diverged_; }
  /// All robots have finished. An interrupt finishes them, too.
  bool over() const;

  std::uint64_t now_us() const { return world_.now_us(); }
  /// Quantities of the world and of all robots; call it after the last add(). Built on the first
  /// call, so that a run without interventions does not pay for it. Set a quantity through
  /// Robot::intervene() if the run must be repeatable.
  sim::Quantities& quantities();
  /// Objects of the world's file; null: the world has no file.
  const sim::Scenery* scenery() { return world_.scenery(); }
  std::size_t size() const { return seats_.size(); }
  Robot& robot(std::size_t index);
  std::size_t index_of(const Robot& robot) const;
  /// Result of a robot; call it once, at the end.
  WalkResult result(std::size_t index);

 private:
  struct Seat;

  Seat* next();
  bool go_on(Seat& seat);
  Robot* next_tick();
  void need_room(const sim::Vec3& start_m) const;

  const Options options_;
  sim::World world_;
  std::deque<std::unique_ptr<Seat>> seats_;
  std::unique_ptr<sim::Quantities> quantities_;  ///< destroyed before its robots
  double wall_s_ = 0;                            ///< spent in tick()
  std::string diverged_;
  bool begun_ = false;
};

/// Height of the ground on which a robot starts.
double ground_m(const sim::World& world, const sim::Vec3& start_m);

/// Observes a run from its beginning to its end, without changing a bit of it.
class Observer {
 public:
  virtual ~Observer() = default;
  /// A robot is about to join; the observer may set hooks.
  virtual void join(std::size_t, const WalkPlan&, Hooks&) {}
  /// All robots have joined, before the first tick.
  virtual void begin(Session&) {}
  /// The robot with this index has done a tick, or its controller keeps the world waiting.
  virtual void tick(std::size_t, Robot&) {}
  /// The run is over.
  virtual void end(Session&) {}
};

/// Runs a session from its first tick to its last. Robot i follows plan i, and result i belongs to
/// it. If the physics diverge, every result is a failure that says so.
std::vector<WalkResult> run(Session& session, const std::vector<WalkPlan>& plans,
                            const std::vector<Observer*>& observers,
                            const MakeController& make = make_controller);

/// Runs one walk of one robot.
WalkResult walk(const WalkPlan& plan, Hooks hooks = {}, Options options = {});

}  // namespace verp::session
