#pragma once
#include <cstdint>
#include <deque>
#include <utility>

#include "common/io/io.hpp"
#include "firmware/app/contracts.hpp"

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
};

}  // namespace verp::session
