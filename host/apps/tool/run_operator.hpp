#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "common/control/state.hpp"
#include "common/safety/machine.hpp"
#include "firmware/app/contracts.hpp"
#include "host/author/action/play_operator.hpp"
#include "host/run/session/fall_story.hpp"
#include "host/run/session/walk_operator.hpp"

namespace verp::tool {

/// The person at the desk during `verp run`: has the robot stand, walk (or act) and stop, and in
/// the end, whatever happened, sit down and let go. Waits while the robot holds; a robot that let
/// go by itself is not made to rise again.
class RunOperator {
 public:
  /// Called when the robot's mode has changed. `story`: of one that fell, in words; or empty.
  using Told = std::function<void(safety::Mode from, safety::Mode to, std::uint32_t faults,
                                  const std::string& story)>;

  /// `get_ups`: how often in a row it is asked to get up once it lies; 0: a fall ends the walk.
  RunOperator(const Params& params, const Command& velocity, double walk_s, Told told,
              int get_ups = 0);

  app::OperatorOrder order(std::uint32_t tick);
  /// What the controller put out in the tick just done.
  void observe(const State& state, const Outputs& outputs);

  /// Orders come from there, for so long as the walk was to take; not from who started the run.
  using Orders = std::function<app::OperatorOrder(std::uint32_t tick)>;
  void obey(Orders orders) { orders_ = std::move(orders); }

  /// Instead of a walk: this action of its library, once.
  void play(int number) { player_.emplace(number, period_s_); }

  /// From now on: sit down, then let go.
  void sit_down() { sitting_ = true; }
  /// From now on: no torque.
  void let_go() { limp_ = true; }

  /// Torque is off, and was so for as long as it takes to tell every servo.
  bool over() const { return quiet_ticks_ >= kQuietTicks; }
  double walked_s() const { return orders_ ? walked_s_ : walker_.walked_s(); }
  /// How often it came to lie, and got up.
  int falls() const { return story_.falls(); }
  int get_ups() const { return story_.get_ups(); }
  /// Of the action, so far.
  double played_s() const { return player_ ? player_->played_s() : 0; }
  /// Why the walk is no good, in words; empty: it is.
  const std::string& failure() const { return failure_; }

 private:
  static constexpr int kQuietTicks = 10;  ///< over three times App's repeats of a change of torque

  void fail(const std::string& why);
  void observe_mode(safety::Mode from, const State& state, const Outputs& outputs);
  void observe_obeying(std::uint32_t faults);
  void observe_playing(const State& state, const Outputs& outputs);

  session::WalkOperator walker_;
  std::optional<action::PlayOperator> player_;
  Told told_;
  Orders orders_;
  const double period_s_, most_s_;
  const bool gets_up_;
  session::FallStory story_;
  double obeyed_s_ = 0, walked_s_ = 0;  ///< with orders_
  Command relax_;
  safety::Mode mode_ = safety::Mode::kRelaxed;
  std::string failure_;
  int quiet_ticks_ = 0;
  bool sitting_ = false, limp_ = false, risen_ = false;
};

}  // namespace verp::tool
