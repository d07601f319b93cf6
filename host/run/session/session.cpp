#include "host/run/session/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "host/run/session/flow.hpp"

namespace verp::session {

/// A single robot's bus advances the world. With several, each controller is a Flow that pauses
/// where its bus requests a time.
struct Session::Seat final : sim::TimeSource {
  Seat(Session& session, const WalkPlan& plan, Hooks hooks, const MakeController& make)
      : world(session.world_),
        robot(world, plan, with_decide_outside(std::move(hooks)), session.options_.interrupted),
        controller(make(robot)),
        start_m(plan.twin.start_m) {
    robot.twin().set_time(*this);
  }

  /// A user's controller runs on the stack of tick()'s caller.
  Hooks with_decide_outside(Hooks hooks) {
    if (!hooks.decide) return hooks;
    hooks.decide = [this, decide = std::move(hooks.decide)](const Params& params, State& state,
                                                            const Inputs& in, Outputs& out) {
      if (!flow) return decide(params, state, in, out);
      flow->outside([&] { decide(params, state, in, out); });
    };
    return hooks;
  }

  void advance_to(std::uint64_t time_us) override {
    if (!flow) return world.advance_to(time_us);
    if (time_us < world.now_us() + world.options().step_us) return;
    asked_us = time_us;
    flow->pause();
  }

  void run(Flow& own) {
    while (!robot.over() && controller->tick()) {
      ticked = true;
      own.pause();
    }
    controller->finish();
  }

  sim::World& world;
  Robot robot;
  std::unique_ptr<Controller> controller;
  const sim::Vec3 start_m;
  std::unique_ptr<Flow> flow;  ///< null: single robot; destroyed before the controller
  std::uint64_t asked_us = 0;
  bool ticked = false;    ///< next_tick() has not returned it
  bool finished = false;  ///< its run is over
};

Session::Session(Options options) : options_(std::move(options)), world_(options_.world) {}

Session::~Session() = default;

double ground_m(const sim::World& world, const sim::Vec3& start_m) {
  constexpr double kFootprint_m = 0.12;  // around the start position
  if (world.scenery() == nullptr) return start_m.z();
  return world.height_m(start_m.x(), start_m.y(), kFootprint_m);
}

/// Throws NoRoom: a tick of robots inside each other takes minutes.
void Session::need_room(const sim::Vec3& start_m) const {
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    const sim::Vec3 way_m = start_m - seats_[i]->start_m;
    if (way_m.head<2>().norm() >= kLeastApart_m) continue;
    throw NoRoom(fmt::format("robot {} stands there already: robots begin at least {:g} m apart", i,
                             kLeastApart_m));
  }
}

Robot& Session::add(const WalkPlan& plan, Hooks hooks, const MakeController& make) {
  if (begun_) throw std::logic_error("a robot joins a session before its first tick");
  need_room(plan.twin.start_m);
  WalkPlan placed = plan;
  placed.twin.start_m.z() = ground_m(world_, placed.twin.start_m);
  seats_.push_back(std::make_unique<Seat>(*this, placed, std::move(hooks), make));
  Robot& robot = seats_.back()->robot;
  robot.set_quantities([this]() -> sim::Quantities& { return quantities(); });
  return robot;
}

sim::Quantities& Session::quantities() {
  if (quantities_) return *quantities_;
  quantities_ = std::make_unique<sim::Quantities>(world_);
  if (world_.scenery() != nullptr) quantities_->add(*world_.scenery());
  std::vector<std::string> names;
  for (const auto& seat : seats_) names.push_back(seat->robot.name());
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    const auto others =
        std::count(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]);
    const std::string number = others > 0 ? std::to_string(others + 1) : "";
    quantities_->add(seats_[i]->robot.twin(), seats_.size() == 1 ? "" : names[i] + number + ".");
  }
  return *quantities_;
}

Robot& Session::robot(std::size_t index) {
  return seats_.at(index)->robot;
}

std::size_t Session::index_of(const Robot& robot) const {
  std::size_t index = 0;
  while (&seats_.at(index)->robot != &robot) ++index;
  return index;
}

bool Session::over() const {
  for (const auto& seat : seats_) {
    if (!seat->finished) return false;
  }
  return true;
}

/// The robot with the earliest time; of equals, the first added.
Session::Seat* Session::next() {
  Seat* first = nullptr;
  for (const auto& seat : seats_) {
    if (seat->finished) continue;
    if (first == nullptr || seat->asked_us < first->asked_us) first = seat.get();
  }
  return first;
}

/// Runs until its controller did a tick or its bus requests a time. False: it has finished.
bool Session::go_on(Seat& seat) {
  seat.finished = true;  // stays so if the controller throws
  if (seat.flow) {
    world_.advance_to(seat.asked_us);
    seat.finished = !seat.flow->resume();
  } else {
    seat.ticked = !seat.robot.over() && seat.controller->tick();
    seat.finished = !seat.ticked;
    if (seat.finished) seat.controller->finish();
  }
  return !seat.finished;
}

Robot* Session::tick() {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  if (!std::exchange(begun_, true) && seats_.size() > 1) {
    for (const auto& seat : seats_) {
      seat->flow = std::make_unique<Flow>([seat = seat.get()](Flow& own) { seat->run(own); });
    }
  }
  Robot* ticked = nullptr;
  try {
    ticked = diverged_.empty() ? next_tick() : nullptr;
  } catch (const sim::Diverged& error) {
    diverged_ = error.what();
    for (const auto& seat : seats_) seat->robot.fail(diverged_);
  }
  wall_s_ += std::chrono::duration<double>(Clock::now() - start).count();
  return ticked;
}

Robot* Session::next_tick() {
  while (Seat* seat = next()) {
    if (!go_on(*seat) || !std::exchange(seat->ticked, false)) continue;
    seat->robot.see();
    return &seat->robot;
  }
  return nullptr;
}

WalkResult Session::result(std::size_t index) {
  Seat& seat = *seats_.at(index);
  return seat.robot.result(seat.controller->wall_s(wall_s_));
}

std::vector<WalkResult> run(Session& session, const std::vector<WalkPlan>& plans,
                            const std::vector<Observer*>& observers, const MakeController& make) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    Hooks hooks;
    for (Observer* each : observers) each->join(i, plans[i], hooks);
    session.add(plans[i], std::move(hooks), make);
  }
  for (Observer* each : observers) each->begin(session);
  while (Robot* robot = session.tick()) {
    for (Observer* each : observers) each->tick(session.index_of(*robot), *robot);
  }
  for (Observer* each : observers) each->end(session);
  std::vector<WalkResult> results;
  for (std::size_t i = 0; i < plans.size(); ++i) results.push_back(session.result(i));
  return results;
}

WalkResult walk(const WalkPlan& plan, Hooks hooks, Options options) {
  Session session(std::move(options));
  session.add(plan, std::move(hooks));
  while (session.tick() != nullptr) {
  }
  return session.result(0);
}

}  // namespace verp::session
