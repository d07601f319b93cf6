#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "common/record/tick_record.hpp"
#include "common/safety/machine.hpp"
#include "firmware/app/contracts.hpp"
#include "host/robot/model/entity.hpp"
#include "host/twin/sim/quantities.hpp"
#include "host/twin/sim/robot.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::test {

struct TwinRun {
  std::vector<TickRecord> records;
  std::vector<safety::Mode> modes;  ///< in order; only of runs in this process
  double distance_m = 0;            ///< over ground
  std::vector<double> pushed_m;     ///< from the start to where hands pushed it
  bool fallen = false;
};

/// Stands up, walks from six seconds after the start until three before the end, then stands. 4 cm
/// steps or, if `wandering`, another way every three seconds.
class ScriptedOperator {
 public:
  ScriptedOperator(const Params& params, std::uint32_t ticks, bool wandering)
      : period_us_(params.period_us), ticks_(ticks), wandering_(wandering) {}
  app::OperatorOrder order(std::uint32_t tick) const;

 private:
  std::uint32_t period_us_;
  std::uint32_t ticks_;
  bool wandering_;
};

struct Hand {
  double at_s = 0;  ///< world time: ticks begin about 0.7 s later
  sim::Vec3 force_world_n = sim::Vec3::Zero();
  double for_s = 0;
};

/// Orders by the tick alone, hands by the world's time.
struct Script {
  std::uint32_t ticks = 0;
  std::function<app::OperatorOrder(std::uint32_t tick)> order;
  std::vector<Hand> hands = {};             ///< in order of time
  std::vector<std::uint32_t> actions = {};  ///< the controller's library
};

struct Orders {
  const Script& script;
  app::OperatorOrder order(std::uint32_t tick) const { return script.order(tick); }
};

/// They push at the same step, however often the world is read.
class Hands : private sim::Actor {
 public:
  Hands(sim::World& world, sim::TwinRobot& body)
      : world_(world), body_(body), start_(body.truth().com_world_m), quantities_(world) {
    quantities_.add(body);
    world_.add(*this);
  }
  ~Hands() override { world_.remove(*this); }
  Hands(const Hands&) = delete;
  Hands& operator=(const Hands&) = delete;
  void take(const Script& script) { waiting_ = {script.hands.begin(), script.hands.end()}; }
  /// From the start over ground, at each push.
  const std::vector<double>& pushed_m() const { return pushed_m_; }
  double distance_m() const { return (body_.truth().com_world_m - start_).head<2>().norm(); }

 private:
  void before_step(double) override {
    while (!waiting_.empty() &&
           1e6 * waiting_.front().at_s <= static_cast<double>(world_.now_us())) {
      pushed_m_.push_back(distance_m());
      quantities_.push("trunk", waiting_.front().force_world_n, waiting_.front().for_s);
      waiting_.pop_front();
    }
  }
  void after_step(double) override {}

  sim::World& world_;
  const sim::TwinRobot& body_;
  const sim::Vec3 start_;
  sim::Quantities quantities_;
  std::deque<Hand> waiting_;
  std::vector<double> pushed_m_;
};

struct Robot {
  model::Entity entity;
  Params params;
};
/// Empty: its first bus.
Robot load_robot(const std::string& name, const std::string& bus = {});

Script walk_script(const Params& params, std::uint32_t ticks, bool wandering = false);

/// 42 s: walks, turns, is pushed, is pushed over, gets up, kicks and waves.
Script tour_script(const Robot& robot);
inline constexpr safety::Mode kTourModes[] = {
    safety::Mode::kRising,   safety::Mode::kStanding,  safety::Mode::kWalking,
    safety::Mode::kStanding, safety::Mode::kWalking,   safety::Mode::kFalling,
    safety::Mode::kFallen,   safety::Mode::kGettingUp, safety::Mode::kStanding,
    safety::Mode::kActing,   safety::Mode::kStanding,  safety::Mode::kActing,
    safety::Mode::kStanding};
/// Is pushed over and gets up with the robot's own actions, in 15 s.
Script fall_script(const Robot& robot);
inline constexpr safety::Mode kFallModes[] = {safety::Mode::kRising,    safety::Mode::kStanding,
                                              safety::Mode::kFalling,   safety::Mode::kFallen,
                                              safety::Mode::kGettingUp, safety::Mode::kStanding};
std::string modes_text(const std::vector<safety::Mode>& modes);

/// All in this process.
TwinRun run_here(const Robot& robot, const Script& script);
TwinRun run_here(const Robot& robot, std::uint32_t ticks, bool wandering);
TwinRun run_on_board(const std::string& board, const Robot& robot, const Script& script);

}  // namespace verp::test
