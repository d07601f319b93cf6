#include "host/trace/record/replay.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "common/control/step.hpp"
#include "host/trace/record/trace_parts.hpp"

namespace verp::record {
namespace {

std::string hex(std::uint32_t value) {
  return fmt::format("0x{:08x}", value);
}
std::string hex(std::uint64_t value) {
  return fmt::format("0x{:016x}", value);
}

}  // namespace

std::optional<Divergence> compare_digests(const TickDigest& left, const TickDigest& right) {
  for (int stage = 0; stage < kStages; ++stage) {
    if (left.stage[stage] == right.stage[stage]) continue;
    Divergence found;
    found.stage = kStageNames[stage];
    found.left_digest = hex(left.stage[stage]);
    found.right_digest = hex(right.stage[stage]);
    return found;
  }
  if (left.chain == right.chain) return std::nullopt;
  Divergence found;
  found.stage = "chain";
  found.left_digest = hex(left.chain);
  found.right_digest = hex(right.chain);
  return found;
}

std::vector<FieldDifference> diff_states(const State& left, State right) {
  right.digest = left.digest;
  return diff_fields(left, right);
}

namespace {

const Keyframe* keyframe_from(const Trace& trace, std::size_t index) {
  const auto found =
      std::lower_bound(trace.keyframes.begin(), trace.keyframes.end(), index,
                       [](const Keyframe& keyframe, std::size_t i) { return keyframe.index < i; });
  return found == trace.keyframes.end() ? nullptr : &*found;
}

void place(Divergence& divergence, const Trace& trace, std::size_t index) {
  divergence.index = index;
  divergence.tick = divergence.fields_tick = trace.ticks[index].inputs.tick;
}

/// Runs with the trace's robot and this program's core, while digests match.
class Reference {
 public:
  explicit Reference(const Trace& trace) : trace_(trace), state_(trace.start()) {}
  void advance(const TickRecord& record) {
    if (!valid_) return;
    Outputs outputs;
    step(trace_.params, actions_, state_, record.inputs, outputs);
    valid_ = !compare_digests(record.digest, state_.digest);
  }
  bool valid() const { return valid_; }
  const State& state() const { return state_; }

 private:
  const Trace& trace_;
  const action::Library actions_ = trace_.library();
  State state_;
  bool valid_ = true;
};

/// Tick by tick. Without a reference, fields are named from the first State kept at or after the
/// divergence.
class Replay {
 public:
  Replay(const Trace& head, const Params* other, const StepFunction& core)
      : params_(other != nullptr ? *other : head.params),
        actions_(head.library()),
        core_(core),
        foreign_(other != nullptr || core),
        state_(head.start()),
        reference_(head) {
    result_.recorded_digest = head.start().digest.chain;
  }

  void tick(const TickRecord& record) {
    Outputs outputs;
    if (core_) {
      core_(params_, state_, record.inputs, outputs);
    } else {
      step(params_, actions_, state_, record.inputs, outputs);
    }
    const std::size_t index = result_.ticks++;
    tick_ = record.inputs.tick;
    result_.recorded_digest = record.digest.chain;
    if (result_.divergence) return;
    if (foreign_) reference_.advance(record);
    result_.divergence = compare_digests(record.digest, state_.digest);
    if (!result_.divergence) return;
    result_.divergence->index = index;
    result_.divergence->tick = result_.divergence->fields_tick = tick_;
    is_named_ = foreign_ && reference_.valid();
    if (is_named_) result_.divergence->fields = diff_states(reference_.state(), state_);
  }
  void keyframe(const State& kept) {
    if (!result_.divergence || std::exchange(is_named_, true)) return;
    result_.divergence->fields = diff_states(kept, state_);
    result_.divergence->fields_tick = tick_;
  }
  ReplayResult result() {
    result_.replayed_digest = state_.digest.chain;
    return result_;
  }

 private:
  const Params& params_;
  const action::Library actions_;
  const StepFunction& core_;
  const bool foreign_;
  State state_;
  Reference reference_;
  ReplayResult result_;
  std::uint32_t tick_ = 0;
  bool is_named_ = false;  ///< of the divergence
};

}  // namespace

ReplayResult replay(const Trace& trace, const Params* other, const StepFunction& core) {
  Replay replay(trace, other, core);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < trace.ticks.size(); ++i) {
    replay.tick(trace.ticks[i]);
    for (; kept < trace.keyframes.size() && trace.keyframes[kept].index == i; ++kept)
      replay.keyframe(trace.keyframes[kept].state);
  }
  return replay.result();
}

ReplayResult replay(TraceFile& trace, const StepFunction& core) {
  Replay replay(trace.head(), nullptr, core);
  trace.read({.tick = [&](const TickRecord& record) { replay.tick(record); },
              .keyframe = [&](const State& state) { replay.keyframe(state); },
              .change = {},
              .body = {},
              .objects = {}});
  return replay.result();
}

namespace {

std::optional<Divergence> diff_params(const Trace& left, const Trace& right) {
  Divergence found;
  found.stage = "params";
  found.fields = diff_fields(left.params, right.params);
  if (found.fields.empty()) return std::nullopt;
  return found;
}

std::optional<Divergence> diff_lengths(const Trace& left, const Trace& right) {
  if (left.ticks.size() == right.ticks.size()) return std::nullopt;
  const bool left_longer = left.ticks.size() > right.ticks.size();
  Divergence found;
  place(found, left_longer ? left : right, std::min(left.ticks.size(), right.ticks.size()));
  found.stage = "length";
  found.left_digest = fmt::format("{} ticks", left.ticks.size());
  found.right_digest = fmt::format("{} ticks", right.ticks.size());
  return found;
}

/// Equal inputs, different digests: another build made one trace. Names the field from both
/// re-runs, or from kept States.
void name_from_both(Divergence& divergence, const Trace& left, const Trace& right,
                    const Reference& left_run, const Reference& right_run) {
  if (left_run.valid() && right_run.valid()) {
    divergence.fields = diff_states(left_run.state(), right_run.state());
    return;
  }
  for (const Keyframe* at = keyframe_from(left, divergence.index); at != nullptr;
       at = keyframe_from(left, at->index + 1)) {
    const Keyframe* same = keyframe_from(right, at->index);
    if (same == nullptr) return;
    if (same->index != at->index) continue;
    divergence.fields = diff_states(at->state, same->state);
    divergence.fields_tick = left.ticks[at->index].inputs.tick;
    if (!divergence.fields.empty()) return;
  }
}

}  // namespace

std::optional<Divergence> diff(const Trace& left, const Trace& right) {
  if (auto found = diff_params(left, right)) return found;
  const std::size_t common = std::min(left.ticks.size(), right.ticks.size());
  Reference left_run(left), right_run(right);
  for (std::size_t i = 0; i < common; ++i) {
    const TickRecord &a = left.ticks[i], &b = right.ticks[i];
    Divergence found;
    found.fields = diff_fields(a.inputs, b.inputs);
    if (!found.fields.empty()) {
      place(found, left, i);
      found.stage = "inputs";
      return found;
    }
    left_run.advance(a);
    right_run.advance(b);
    if (auto digests = compare_digests(a.digest, b.digest)) {
      place(*digests, left, i);
      name_from_both(*digests, left, right, left_run, right_run);
      return digests;
    }
  }
  return diff_lengths(left, right);
}

namespace {
/// "position_count[3]" becomes "position_count[3] (l_knee)".
std::string with_joint_name(const std::string& path, const Params& params) {
  const std::size_t open = path.rfind('[');
  if (open == std::string::npos || path.back() != ']') return path;
  const std::string base = path.substr(0, open);
  const bool per_joint = base.ends_with("_count") || base.ends_with("_rad");
  const unsigned long j = std::stoul(path.substr(open + 1));
  if (!per_joint || j >= params.joint_count) return path;
  if (base.ends_with("gyro_count") || base.ends_with("accel_count") ||
      base.ends_with("foot_count") || base.find("foot_count[") != std::string::npos) {
    return path;
  }
  const char* name = params.joint[j].name;
  return fmt::format("{} ({})", path, std::string(name, ::strnlen(name, kNameLength)));
}
}  // namespace

std::string text(const Divergence& divergence, const Params& params, const char* left,
                 const char* right) {
  std::string line;
  if (divergence.stage == "params") {
    line = "robot (Params)";
  } else {
    line = fmt::format("tick {} ({:.3f} s): stage {}", divergence.tick,
                       divergence.tick * (params.period_us * 1e-6), divergence.stage);
  }
  if (!divergence.left_digest.empty()) {
    line +=
        fmt::format(": {} {}, {} {}", left, divergence.left_digest, right, divergence.right_digest);
  }
  if (divergence.fields.empty()) return line;
  const FieldDifference& field = divergence.fields.front();
  line += fmt::format(": field {}: {} {}, {} {}", with_joint_name(field.path, params), left,
                      field.left, right, field.right);
  if (divergence.fields_tick != divergence.tick) {
    line += fmt::format(" (in the State kept at tick {})", divergence.fields_tick);
  }
  if (divergence.fields.size() > 1) {
    line += fmt::format(", and {} more fields", divergence.fields.size() - 1);
  }
  return line;
}

}  // namespace verp::record
