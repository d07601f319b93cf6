#pragma once
#include <cstdint>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "firmware/app/contracts.hpp"

namespace verp::action {

/// Stands, requests an action once the robot is quiet, and waits until it stands again.
class PlayOperator {
 public:
  /// Limits for the stand or the action's begin, and for the action.
  static constexpr double kStandUp_s = 15, kMostAction_s = 300;

  PlayOperator(int number, double period_s) : number_(number), period_s_(period_s) {}

  app::OperatorOrder order(std::uint32_t tick);
  void observe(const State& state, const Outputs& outputs);

  bool done() const { return done_; }
  double played_s() const { return played_s_; }
  const char* failed() const { return failed_; }

 private:
  int number_;
  double period_s_;
  Command command_;
  double waited_s_ = 0, stood_s_ = 0, played_s_ = 0;
  bool asked_ = false, done_ = false, changed_ = true;
  const char* failed_ = "";
};

}  // namespace verp::action
