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

class TraceFile;

/// First tick and field whose bits differ.
struct Divergence {
  std::size_t index = 0;   ///< into Trace::ticks
  std::uint32_t tick = 0;  ///< Inputs::tick there
  std::string stage;       ///< of kStageNames, or "inputs", "params", "chain"
  std::string left_digest, right_digest;
  /// Empty: no State was kept at or after the divergence.
  std::vector<FieldDifference> fields;
  std::uint32_t fields_tick = 0;  ///< this tick, or the next kept State's
};

/// First differing stage, or only the chain; nullopt: equal. Leaves tick and fields unset.
std::optional<Divergence> compare_digests(const TickDigest& left, const TickDigest& right);

/// Differences without digests, which only follow.
std::vector<FieldDifference> diff_states(const State& left, State right);

struct ReplayResult {
  std::size_t ticks = 0;
  std::uint64_t recorded_digest = 0;
  std::uint64_t replayed_digest = 0;
  std::optional<Divergence> divergence;
};

/// Compares every stage of every tick. `other` replaces the robot, `core` this program's step().
/// The trace's own robot runs along to name the field.
ReplayResult replay(const Trace& trace, const Params* other = nullptr,
                    const StepFunction& core = nullptr);
/// Holds one chunk of the trace.
ReplayResult replay(TraceFile& trace, const StepFunction& core = nullptr);

/// Robots, inputs by field, then stages. A prefix of the other trace: stage "length".
std::optional<Divergence> diff(const Trace& left, const Trace& right);

/// Tick, time, stage, field and both values. `left`, `right`: their labels.
std::string text(const Divergence& divergence, const Params& params, const char* left,
                 const char* right);

}  // namespace verp::record
