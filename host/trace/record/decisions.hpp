#pragma once
#include "common/action/library.hpp"
#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::record {

/// The controller's outputs for each tick of a trace. It stops where this program decides
/// differently from the recording one.
class Decisions {
 public:
  /// The trace must outlive this object.
  explicit Decisions(const Trace& trace)
      : trace_(trace), actions_(trace.library()), state_(trace.start()) {}
  /// Null: unknown. Call for every tick, in order.
  const Outputs* at(const TickRecord& record);
  /// The State after the last at().
  const State& state() const { return state_; }

 private:
  const Trace& trace_;
  const action::Library actions_;
  State state_;
  Outputs outputs_;
  bool same_ = true;
};

}  // namespace verp::record
