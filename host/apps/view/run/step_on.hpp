#pragma once
#include <cstddef>
#include <deque>
#include <utility>

#include "common/control/state.hpp"
#include "host/show/scene/from_trace.hpp"

namespace verp::view {

/// A controller that continues from a trace's tick over the recorded Inputs. It repeats the record
/// until a change; then State and Outputs show the change's effect.
class StepOn {
 public:
  /// `player` must outlive it.
  StepOn(const scene::TracePlayer& player, std::size_t index);

  /// Runs so many ticks; stops at the trace's end.
  void on(int ticks);
  /// As an operator would: one a tick, from the next tick on.
  void write(int id, float value) { writes_.emplace_back(id, value); }

  std::size_t index() const { return index_; }
  bool ended() const { return index_ + 1 >= player_.size(); }
  const Inputs& inputs() const { return player_.trace().ticks[index_].inputs; }
  const State& state() const { return state_; }
  const Outputs& outputs() const { return outputs_; }
  bool same_bits() const;

 private:
  const scene::TracePlayer& player_;
  std::size_t index_;
  State state_;
  Outputs outputs_;
  std::deque<std::pair<int, float>> writes_;
};

}  // namespace verp::view
