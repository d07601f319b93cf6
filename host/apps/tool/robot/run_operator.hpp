#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "common/control/state.hpp"
#include "common/safety/machine.hpp"
#include "firmware/app/contracts.hpp"
#include "host/apps/tool/robot/run_ending.hpp"
#include "host/author/action/play_operator.hpp"
#include "host/os/link/stop_line.hpp"
#include "host/run/session/fall_story.hpp"
#include "host/run/session/walk_operator.hpp"

namespace verp::tool {

/// Orders stand, walk (or act) and stop, then always sit down and torque off. Waits while the robot
/// holds. Does not raise a robot that released torque by itself.
class RunOperator {
 public:
  /// The robot's mode has changed. `story`: a fall in words, or empty. `silent`: the device that
  /// holds it, or empty.
  using Told = std::function<void(safety::Mode from, safety::Mode to, std::uint32_t faults,
                                  const std::string& story, const std::string& silent)>;

  /// `get_ups`: attempts in a row after a fall; 0: a fall ends the walk. `stands`: instead of a
  /// walk.
  RunOperator(const Params& params, const Command& velocity, double walk_s, Told told,
              int get_ups = 0, bool stands = false);

  app::OperatorOrder order(std::uint32_t tick);
  void observe(const State& state, const Outputs& outputs);

  /// Obeys another source for the planned length of the walk.
  using Orders = std::function<app::OperatorOrder(std::uint32_t tick)>;
  void obey(Orders orders) { orders_ = std::move(orders); }

  /// A button that stops the robot while it is pressed, and ends the run.
  void stop_at(link::StopLine& stop) { stop_ = &stop; }

  /// Plays the action once, instead of a walk.
  void play(int number) { player_.emplace(number, period_s_); }

  /// From now on: sit down, then release torque.
  void sit_down() { sitting_ = true; }
  /// From now on: no torque.
  void let_go() { limp_ = true; }

  /// Torque has been off long enough for every servo to receive that, and for a fall to be seen.
  bool over() const { return quiet_ticks_ >= kQuietTicks && ending_.limp_s() >= kFalls_s; }
  /// How it ended, in words.
  std::string ended() const { return ending_.words(); }
  double walked_s() const { return orders_ ? walked_s_ : walker_.walked_s(); }
  int falls() const { return story_.falls(); }
  int get_ups() const { return story_.get_ups(); }
  double played_s() const { return player_ ? player_->played_s() : 0; }
  /// Why the walk failed; empty: it did not.
  const std::string& failure() const { return failure_; }

 private:
  static constexpr int kQuietTicks = 10;   ///< over three times App's repeats
  static constexpr double kFalls_s = 2.0;  ///< a crouch that tips over lies after 1.5 s

  app::OperatorOrder wish(std::uint32_t tick);
  void fail(const std::string& why);
  void observe_mode(safety::Mode from, const State& state, const Outputs& outputs);
  void observe_obeying(std::uint32_t faults);
  void observe_playing(const State& state, const Outputs& outputs);

  const Params& params_;
  session::WalkOperator walker_;
  std::optional<action::PlayOperator> player_;
  Told told_;
  Orders orders_;
  link::StopLine* stop_ = nullptr;
  const double period_s_, most_s_;
  const bool gets_up_;
  session::FallStory story_;
  RunEnding ending_;
  double obeyed_s_ = 0, walked_s_ = 0;  ///< with orders_
  Command relax_;
  safety::Mode mode_ = safety::Mode::kRelaxed;
  std::string failure_;
  std::string silent_;  ///< why it holds
  int quiet_ticks_ = 0;
  bool sitting_ = false, limp_ = false, risen_ = false;
};

}  // namespace verp::tool
