#include "host/trace/record/decisions.hpp"

#include "common/control/step.hpp"

namespace verp::record {

const Outputs* Decisions::at(const TickRecord& record) {
  if (!same_) return nullptr;
  step(trace_.params, actions_, state_, record.inputs, outputs_);
  same_ = state_.digest.chain == record.digest.chain;
  return same_ ? &outputs_ : nullptr;
}

}  // namespace verp::record
