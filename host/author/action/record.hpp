#pragma once
#include <string>

#include "host/author/action/document.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::action {

struct RecordOptions {
  std::string name;
  double from_s = 0, to_s = 1e9;  ///< in the trace
  double every_s = 0.1;
};

/// One frame of measured joints per interval, also for a robot moved by hand. Throws LoadError
/// without a tick in that time.
Document record_joints(const record::Trace& trace, const RecordOptions& options);

/// A mid-walk cycle's 16 planned states, without balance and gravity corrections, `cycles` times.
/// Throws LoadError without a whole cycle.
Document record_gait(const record::Trace& trace, const std::string& name, int cycles);

}  // namespace verp::action
