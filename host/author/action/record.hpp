#pragma once
#include <string>

#include "host/author/action/document.hpp"
#include "host/trace/record/trace.hpp"

/// Actions out of what a robot did, as its trace tells.
namespace verp::action {

struct RecordOptions {
  std::string name;
  double from_s = 0, to_s = 1e9;  ///< of the trace
  double every_s = 0.1;
};

/// A key frame every so often, where the joints were: of a robot that was moved by hand, too.
/// Throws LoadError if the trace has no tick there.
Document record_joints(const record::Trace& trace, const RecordOptions& options);

/// The 16 states of one cycle in the midst of a walk, as planned, without what balance and gravity
/// add; repeated so often. Throws LoadError for a trace without a whole cycle.
Document record_gait(const record::Trace& trace, const std::string& name, int cycles);

}  // namespace verp::action
