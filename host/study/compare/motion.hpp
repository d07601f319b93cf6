#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/trace/record/trace.hpp"

namespace verp::compare {

class Motion {
 public:
  /// Replays the controller over the trace (at least one tick) for its decisions.
  explicit Motion(const record::Trace& trace);

  double period_s() const { return period_s_; }
  double length_s() const { return period_s_ * static_cast<double>(slots_ - 1); }
  const std::vector<std::string>& joints() const { return joints_; }
  /// Time from the first tick, up to length_s. Linear over ticks without a reading; constant before
  /// the first reading.
  double rad(std::size_t joint, double time_s) const;
  /// Share of the ticks with a reading of the joint, 0 to 1.
  double read_share(std::size_t joint) const { return read_share_[joint]; }

  /// Begin of a gait or action after the first tick. nullopt: never, or this program decides
  /// differently from the recording one.
  const std::optional<double>& begun_s() const { return begun_s_; }
  const std::optional<double>& ordered_s() const { return ordered_s_; }
  /// End of the last ordered walk; 0: there was none.
  double walked_until_s() const { return walked_until_s_; }
  double cycle_s() const { return cycle_s_; }
  const Command& order(double time_s) const;

 private:
  void see_orders(const record::Trace& trace);
  void read_joints(const record::Trace& trace);
  std::size_t slot(const record::Trace& trace, std::size_t index) const;

  double period_s_;
  std::size_t slots_ = 0;  ///< ticks with the missing ones
  std::vector<std::string> joints_;
  std::vector<std::vector<double>> rad_;
  std::vector<double> read_share_;
  std::vector<Command> orders_;
  std::optional<double> begun_s_, ordered_s_;
  double walked_until_s_ = 0;
  double cycle_s_;
};

}  // namespace verp::compare
