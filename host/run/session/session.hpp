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
  std::function<bool()> interrupted;  ///< at each tick; true ends the run
};

class NoRoom : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A world and its robots, tick by tick:
///
///     Session session;
///     session.add(plan);
///     while (session.tick()) {
///     }
///     const WalkResult result = session.result(0);
///
/// Each robot's bus waits until the world reaches its requested time. The world advances when all
/// buses have requested a time at least as late, so no robot acts in another's past. Equal plans in
/// equal order give equal bits, whatever the calls' timing. Exceptions end the run of the robot
/// that caused them.
class Session {
 public:
  explicit Session(Options options = {});
  ~Session();

  /// Add robots before the first tick. Throws NoRoom within 0.1 m of another start, and what
  /// TwinRobot's constructor and `make` throw.
  Robot& add(const WalkPlan& plan, Hooks hooks = {}, const MakeController& make = make_controller);

  /// Runs until one robot did a control tick, or its controller kept the session waiting for some
  /// ms. Returns that robot; null: the run is over.
  Robot* tick();
  /// Why the physics diverged, which ends every robot's run; empty: it did not.
  const std::string& diverged() const { return diverged_; }
  /// All robots have finished, or were interrupted.
  bool over() const;

  std::uint64_t now_us() const { return world_.now_us(); }
  /// Call after the last add(). A repeatable run sets quantities through Robot::intervene().
  sim::Quantities& quantities();
  /// Objects of the world's file; null: the world has no file.
  const sim::Scenery* scenery() { return world_.scenery(); }
  std::size_t size() const { return seats_.size(); }
  Robot& robot(std::size_t index);
  std::size_t index_of(const Robot& robot) const;
  /// Call it once, at the end.
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

/// Ground height at a robot's start.
double ground_m(const sim::World& world, const sim::Vec3& start_m);

/// Observes a run and changes no bit of it.
class Observer {
 public:
  virtual ~Observer() = default;
  /// A robot joins; the observer may set hooks.
  virtual void join(std::size_t, const WalkPlan&, Hooks&) {}
  /// All robots have joined.
  virtual void begin(Session&) {}
  /// A robot's tick, or its controller keeps the world waiting.
  virtual void tick(std::size_t, Robot&) {}
  virtual void end(Session&) {}
};

/// Robot i follows plan i and gives result i. If the physics diverge, all results say so.
std::vector<WalkResult> run(Session& session, const std::vector<WalkPlan>& plans,
                            const std::vector<Observer*>& observers,
                            const MakeController& make = make_controller);

WalkResult walk(const WalkPlan& plan, Hooks hooks = {}, Options options = {});

}  // namespace verp::session
