#pragma once
#include <cstdint>
#include <deque>
#include <utility>

#include "common/io/io.hpp"
#include "firmware/app/contracts.hpp"
#include "host/run/session/get_up.hpp"

namespace verp::session {

/// A watching user's orders, which override the run's operator (amend() of Hooks). They reach
/// Inputs through registers, so the run replays.
class LiveOrders {
 public:
  /// The user drives from now on. This class sets the sequence.
  void take(const Command& command);
  void give_back() { driving_ = false; }
  bool driving() const { return driving_; }
  const Command& command() const { return command_; }

  /// While pressed, the robot has no torque.
  void press_emergency_stop(bool pressed);
  bool emergency_stop() const { return stopped_; }

  /// A fallen robot gets up, kGetUpTries times in a row. Then the earlier order holds again; after
  /// the last failure it relaxes.
  void get_up();
  /// Gets up after each future fall.
  void let_get_up(bool by_itself);
  bool gets_up_by_itself() const { return by_itself_; }
  void observe(safety::Mode mode, double period_s);

  /// Writes a tuning number (model/tuning_ranges.hpp), one per tick. Replaces a waiting value of
  /// the same id. False: unknown or out of range.
  bool write(int id, float value);
  std::size_t waiting() const { return writes_.size(); }

  void amend(std::uint32_t tick, app::OperatorOrder& order);

 private:
  Command command_;
  std::uint8_t sequence_ = 0;
  std::deque<std::pair<int, float>> writes_;
  bool driving_ = false, stopped_ = false, changed_ = false;
  bool by_itself_ = false, asked_ = false;  ///< gets up after every fall; now
  GetUp get_up_{kGetUpTries};
};

}  // namespace verp::session
