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

/// The first tick whose bits differ between two runs, and the field.
struct Divergence {
  std::size_t index = 0;   ///< into Trace::ticks
  std::uint32_t tick = 0;  ///< Inputs::tick there
  std::string stage;       ///< of kStageNames; otherwise "inputs", "params" or "chain"
  std::string left_digest, right_digest;
  /// The first differing fields; empty if no State was kept at or after the divergence.
  std::vector<FieldDifference> fields;
  std::uint32_t fields_tick = 0;  ///< tick of `fields`: this one, or that of the next kept State
};

/// The first stage whose digests differ, or only the chain; nullopt: equal. Leaves tick and fields
/// unset.
std::optional<Divergence> compare_digests(const TickDigest& left, const TickDigest& right);

/// Differences of two States, without the digests, which only follow.
std::vector<FieldDifference> diff_states(const State& left, State right);

struct ReplayResult {
  std::size_t ticks = 0;
  std::uint64_t recorded_digest = 0;
  std::uint64_t replayed_digest = 0;
  std::optional<Divergence> divergence;
};

/// Runs the controller over the recorded inputs and compares every stage of every tick. `other`
/// replaces the trace's robot, `core` this program's step(). The trace's own robot then runs along,
/// to name the field at the divergent tick.
ReplayResult replay(const Trace& trace, const Params* other = nullptr,
                    const StepFunction& core = nullptr);

/// The first difference of two traces: robots, inputs by field, then controller stages. If one
/// trace is a prefix of the other: stage "length".
std::optional<Divergence> diff(const Trace& left, const Trace& right);

/// One line: tick, time, stage, field and both values. `left` and `right` label the values.
std::string text(const Divergence& divergence, const Params& params, const char* left,
                 const char* right);

}  // namespace verp::record
