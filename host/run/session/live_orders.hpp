#pragma once
#include <cstdint>
#include <deque>
#include <utility>

#include "common/io/io.hpp"
#include "firmware/app/contracts.hpp"
#include "host/run/session/get_up.hpp"

namespace verp::session {

/// Orders from a user who watches a run; they override the run's own operator (amend() of Hooks).
/// All of them go through the controller's registers into Inputs, as any order does, so the run
/// replays.
class LiveOrders {
 public:
  /// From now on the user drives the robot. This class sets the sequence.
  void take(const Command& command);
  /// From now on the run's own operator drives it again.
  void give_back() { driving_ = false; }
  bool driving() const { return driving_; }
  const Command& command() const { return command_; }

  /// While pressed, the robot has no torque.
  void press_emergency_stop(bool pressed);
  bool emergency_stop() const { return stopped_; }

  /// Orders a fallen robot to get up, kGetUpTries times in a row. Once it stands, the earlier order
  /// holds again. After the last failed attempt, orders it to relax.
  void get_up();
  /// Does the same after each future fall.
  void let_get_up(bool by_itself);
  bool gets_up_by_itself() const { return by_itself_; }
  /// Observes the last tick, which lasted `period_s`.
  void observe(safety::Mode mode, double period_s);

  /// Writes a tuning number (model/tuning_ranges.hpp) in one of the next ticks, one per tick. A new
  /// value replaces a waiting one of the same id. False: no such number, or out of range.
  bool write(int id, float value);
  std::size_t waiting() const { return writes_.size(); }

  void amend(std::uint32_t tick, app::OperatorOrder& order);

 private:
  Command command_;
  std::uint8_t sequence_ = 0;
  std::deque<std::pair<int, float>> writes_;
  bool driving_ = false, stopped_ = false, changed_ = false;
  bool by_itself_ = false, asked_ = false;  ///< get up: after every fall; now
  GetUp get_up_{kGetUpTries};
};

}  // namespace verp::session
