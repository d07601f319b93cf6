#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/trace/record/trace.hpp"

namespace verp::compare {

/// What the joints of a robot did in a trace, and when it was told to.
class Motion {
 public:
  /// Runs the controller over the trace once more, to see what it made of it. The trace must have a
  /// tick.
  explicit Motion(const record::Trace& trace);

  double period_s() const { return period_s_; }
  double length_s() const { return period_s_ * static_cast<double>(slots_ - 1); }
  const std::vector<std::string>& joints() const { return joints_; }
  /// Joint angle at a time from the first tick on, rad: straight lines between readings, which
  /// servos that were silent leave out; before the first reading that one. Nothing beyond length_s.
  double rad(std::size_t joint, double time_s) const;
  /// How many of the ticks had a reading of it, 0 to 1.
  double read_share(std::size_t joint) const { return read_share_[joint]; }

  /// When the gait or an action began, as the controller decided, from the first tick on. None: it
  /// never did, or this program decides otherwise than the one that recorded the trace.
  const std::optional<double>& begun_s() const { return begun_s_; }
  /// When the operator first asked for a walk or an action.
  const std::optional<double>& ordered_s() const { return ordered_s_; }
  /// When the last walk that was asked for was over. 0: none was.
  double walked_until_s() const { return walked_until_s_; }
  /// Of the gait in force at the end.
  double cycle_s() const { return cycle_s_; }
  /// The operator's order at a time.
  const Command& order(double time_s) const;

 private:
  void see_orders(const record::Trace& trace);
  void read_joints(const record::Trace& trace);
  std::size_t slot(const record::Trace& trace, std::size_t index) const;

  double period_s_;
  std::size_t slots_ = 0;  ///< ticks from the first to the last, those that were skipped too
  std::vector<std::string> joints_;
  std::vector<std::vector<double>> rad_;  ///< of each joint at each of them
  std::vector<double> read_share_;
  std::vector<Command> orders_;
  std::optional<double> begun_s_, ordered_s_;
  double walked_until_s_ = 0;
  double cycle_s_;
};

}  // namespace verp::compare
