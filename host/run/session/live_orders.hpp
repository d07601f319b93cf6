#pragma once
#include <cstdint>
#include <deque>
#include <utility>

#include "common/io/io.hpp"
#include "firmware/app/contracts.hpp"
#include "host/run/session/get_up.hpp"

namespace verp::session {

/// What a person who watches a run asks of its robot, over what the run's own operator asks: the
/// amend() of Hooks. All of it goes the way of any order, through the controller's registers into
/// Inputs, so a run that was touched replays.
class LiveOrders {
 public:
  /// From now on the person has the robot. Sequence is this class's business.
  void take(const Command& command);
  /// From now on the run's own operator has it again.
  void give_back() { driving_ = false; }
  bool driving() const { return driving_; }
  const Command& command() const { return command_; }

  /// While it is pressed the robot is limp.
  void press_emergency_stop(bool pressed);
  bool emergency_stop() const { return stopped_; }

  /// A robot that lies is asked to get up, kGetUpTries times in a row; once it stands, what was
  /// ordered holds again. One that did not get up is asked to relax.
  void get_up();
  /// The same of each fall from now on, without a word.
  void let_get_up(bool by_itself);
  bool gets_up_by_itself() const { return by_itself_; }
  /// What the controller put out in the tick just done, which lasted `period_s`.
  void observe(safety::Mode mode, double period_s);

  /// A number of the tuning (model/tuning_ranges.hpp), in one of the next ticks: each carries one.
  /// Of a number that still waits, the last value counts. False: no such number, or not in its
  /// range.
  bool write(int id, float value);
  std::size_t waiting() const { return writes_.size(); }

  void amend(std::uint32_t tick, app::OperatorOrder& order);

 private:
  Command command_;
  std::uint8_t sequence_ = 0;
  std::deque<std::pair<int, float>> writes_;
  bool driving_ = false, stopped_ = false, changed_ = false;
  bool by_itself_ = false, asked_ = false;  ///< to get up: whenever it falls; now
  GetUp get_up_{kGetUpTries};
};

}  // namespace verp::session
