#pragma once
#include "host/session/session.hpp"

namespace verp::action {

/// The person who asks for an action: has the robot stand, asks once it stands quietly, and sees it
/// stand again.
class PlayOperator {
 public:
  PlayOperator(int number, double period_s) : number_(number), period_s_(period_s) {}

  app::OperatorOrder order(std::uint32_t tick);
  void observe(const State& state, const Outputs& outputs);

  bool done() const { return done_; }
  /// Seconds of the action so far.
  double played_s() const { return played_s_; }
  /// Empty unless the robot would not do what it is asked.
  const char* failed() const { return failed_; }

 private:
  int number_;
  double period_s_;
  Command command_;
  double waited_s_ = 0, stood_s_ = 0, played_s_ = 0;
  bool asked_ = false, done_ = false, changed_ = true;
  const char* failed_ = "";
};

struct Played {
  session::WalkResult run;
  double action_s = 0;  ///< from the stand to the stand
  double asked_s = 0;   ///< simulated, when it was asked
};

/// Plays action `number` of plan.actions on the twin. What is asked of `hooks` besides is done.
Played play(session::WalkPlan plan, int number, session::Hooks hooks, session::Options options);

}  // namespace verp::action
