#pragma once
#include "common/action/library.hpp"
#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::record {

/// What the controller made of each tick of a trace: the run once more. Nothing from where this
/// program would decide otherwise than the one that recorded it, as another revision may.
class Decisions {
 public:
  /// The trace must outlive it.
  explicit Decisions(const Trace& trace)
      : trace_(trace), actions_(trace.library()), state_(trace.start()) {}
  /// Null where it is not known. Ticks are asked for in order, none left out.
  const Outputs* at(const TickRecord& record);
  /// After the tick last asked for.
  const State& state() const { return state_; }

 private:
  const Trace& trace_;
  const action::Library actions_;
  State state_;
  Outputs outputs_;
  bool same_ = true;
};

}  // namespace verp::record
