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
  std::function<bool()> interrupted;  ///< asked at each tick; true ends the run. Empty: nobody does
};

/// A robot was to be put down where another one stands.
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
/// The world steps once for everybody in it. Each robot's bus asks for a time, and comes back when
/// the world stands there, which it does when every other bus has asked for one at least as late:
/// so no robot is told of, or acts in, another one's past. Deterministic: equal plans in equal
/// order give equal bits, however the ticks are called for. Who does not call tick() has paused the
/// run. Errors are exceptions with text, after which the robot that they are of is over.
class Session {
 public:
  explicit Session(Options options = {});
  ~Session();

  /// One more robot, before the first tick. Throws NoRoom less than 0.1 m from another one, and
  /// what TwinRobot's constructor and `make` do.
  Robot& add(const WalkPlan& plan, Hooks hooks = {}, const MakeController& make = make_controller);

  /// Goes on until one robot has done one more control tick, or its controller has kept us waiting
  /// for some ms, and returns it. Null: the run is over.
  Robot* tick();
  /// Why the physics gave up, which ends the run of every robot; empty: they did not.
  const std::string& diverged() const { return diverged_; }
  /// All robots are over, or somebody interrupts.
  bool over() const;

  std::uint64_t now_us() const { return world_.now_us(); }
  /// Of the world and all in it, once all robots were added. Made when first asked for: a run that
  /// nobody touches does not pay for it. To set one so that the run can be repeated is
  /// Robot::intervene().
  sim::Quantities& quantities();
  /// What the world's file put there; null: it had none.
  const sim::Scenery* scenery() { return world_.scenery(); }
  std::size_t size() const { return seats_.size(); }
  Robot& robot(std::size_t index);
  std::size_t index_of(const Robot& robot) const;
  /// Of that robot, once, at the end.
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
  std::unique_ptr<sim::Quantities> quantities_;  ///< goes before what it is of
  double wall_s_ = 0;                            ///< in tick()
  std::string diverged_;
  bool begun_ = false;
};

/// At which height a robot is put down there.
double ground_m(const sim::World& world, const sim::Vec3& start_m);

/// Looks at a run from its beginning to its end. Nothing that it does changes a bit of the run.
class Observer {
 public:
  virtual ~Observer() = default;
  /// A robot is about to join: what the observer wants to hear of it goes into the hooks.
  virtual void join(std::size_t, const WalkPlan&, Hooks&) {}
  /// All robots have joined, and none has done a tick.
  virtual void begin(Session&) {}
  /// The robot of that index has done a tick, or its controller keeps the world waiting.
  virtual void tick(std::size_t, Robot&) {}
  /// The run is over.
  virtual void end(Session&) {}
};

/// A run from its first tick to its last, with robot i of the session by plan i. The results are in
/// the same order. One whose physics diverge has failed, and its results say so.
std::vector<WalkResult> run(Session& session, const std::vector<WalkPlan>& plans,
                            const std::vector<Observer*>& observers,
                            const MakeController& make = make_controller);

/// One walk of one robot, from its beginning to its end.
WalkResult walk(const WalkPlan& plan, Hooks hooks = {}, Options options = {});

}  // namespace verp::session
