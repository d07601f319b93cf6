#pragma once
#include <cstddef>
#include <deque>
#include <utility>

#include "common/control/state.hpp"
#include "host/show/scene/from_trace.hpp"

namespace verp::view {

/// A controller that goes on by itself from one tick of a trace, in the shadow of the Inputs that
/// were recorded. As long as nobody changes a number it does what it did; once somebody does, State
/// and Outputs show what that would have meant for what the robot felt.
class StepOn {
 public:
  /// After that tick. `player` outlives it.
  StepOn(const scene::TracePlayer& player, std::size_t index);

  /// As many ticks as the trace still has.
  void on(int ticks);
  /// A number of the tuning, as an operator would write it: one a tick, beginning with the next.
  void write(int id, float value) { writes_.emplace_back(id, value); }

  std::size_t index() const { return index_; }
  bool ended() const { return index_ + 1 >= player_.size(); }
  const Inputs& inputs() const { return player_.trace().ticks[index_].inputs; }
  const State& state() const { return state_; }
  const Outputs& outputs() const { return outputs_; }
  /// The whole run up to here has the digest that was recorded.
  bool same_bits() const;

 private:
  const scene::TracePlayer& player_;
  std::size_t index_;
  State state_;
  Outputs outputs_;
  std::deque<std::pair<int, float>> writes_;
};

}  // namespace verp::view
