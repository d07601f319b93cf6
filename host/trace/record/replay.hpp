#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/trace/record/fields.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::record {

using StepFunction = std::function<void(const Params&, State&, const Inputs&, Outputs&)>;

/// The first tick at which two runs are not the same bits, and where in it.
struct Divergence {
  std::size_t index = 0;   ///< into Trace::ticks
  std::uint32_t tick = 0;  ///< Inputs::tick there
  std::string stage;  ///< of kStageNames; "inputs", "params" or "chain" when no stage is to blame
  std::string left_digest, right_digest;
  /// What differs, first in field order; empty when no State was kept at or after the divergence.
  std::vector<FieldDifference> fields;
  std::uint32_t fields_tick =
      0;  ///< the tick whose fields those are: this one, or the next kept State's
};

/// The first stage whose digests differ, or the chain alone; nothing when the ticks are equal. Has
/// no tick and no fields yet.
std::optional<Divergence> compare_digests(const TickDigest& left, const TickDigest& right);

/// Differences of two States without the digests themselves, which differ as a consequence.
std::vector<FieldDifference> diff_states(const State& left, State right);

struct ReplayResult {
  std::size_t ticks = 0;
  std::uint64_t recorded_digest = 0;
  std::uint64_t replayed_digest = 0;
  std::optional<Divergence> divergence;
};

/// Runs the controller over the recorded inputs and compares every stage of every tick. `other`
/// replaces the trace's own robot; `core` replaces this program's step(). With either, the trace's
/// own robot is run along, so that the field can be named at the very tick.
ReplayResult replay(const Trace& trace, const Params* other = nullptr,
                    const StepFunction& core = nullptr);

/// The first difference of two traces: robots, inputs (field by field), then the controller's
/// stages. Also set when one trace is a prefix of the other: stage "length".
std::optional<Divergence> diff(const Trace& left, const Trace& right);

/// One line: tick, time, stage, field and both values. `left` and `right` say whose values they
/// are.
std::string text(const Divergence& divergence, const Params& params, const char* left,
                 const char* right);

}  // namespace verp::record
