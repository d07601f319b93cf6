#include "host/run/shadow/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>

#include "common/control/step.hpp"

namespace verp::shadow {
namespace {

State stepped(const Params& params, const action::Library& actions, State state,
              const Inputs& inputs) {
  Outputs outputs;
  step(params, actions, state, inputs, outputs);
  return state;
}

/// Diffs the State at the held tick: the differing one or slightly later.
void name_fields(record::Divergence& divergence, const Params& params,
                 const action::Library& actions, State state, const Testimony& testimony,
                 std::size_t from) {
  for (std::size_t i = from; i < testimony.ticks.size(); ++i) {
    state = stepped(params, actions, state, testimony.ticks[i].inputs);
  }
  divergence.fields = record::diff_states(testimony.held.state, state);
  divergence.fields_tick = testimony.held.record.inputs.tick;
}

}  // namespace

std::vector<TickRecord> ticks_of(const std::uint8_t* image, std::size_t size,
                                 const app::HeldTick& held) {
  const std::uint32_t last = held.record.inputs.tick;
  std::vector<TickRecord> ticks;
  for (std::size_t at = 0; at + sizeof(TickRecord) <= size; at += sizeof(TickRecord)) {
    TickRecord record;
    std::memcpy(static_cast<void*>(&record), image + at, sizeof record);
    const std::uint32_t age = last - record.inputs.tick;
    if (record.digest.chain != 0 && age < size / sizeof record) ticks.push_back(record);
  }
  std::sort(ticks.begin(), ticks.end(),
            [](const TickRecord& a, const TickRecord& b) { return a.inputs.tick < b.inputs.tick; });
  return ticks;
}

Judgement judge(const Params& params, const action::Library& actions, const Suspicion& suspicion,
                const Testimony& testimony) {
  const auto found = std::find_if(
      testimony.ticks.begin(), testimony.ticks.end(),
      [&](const TickRecord& each) { return each.inputs.tick == suspicion.inputs.tick; });
  Judgement judgement;
  record::Divergence& divergence = judgement.divergence;
  divergence.tick = divergence.fields_tick = suspicion.inputs.tick;
  divergence.stage = "inputs";
  if (found == testimony.ticks.end() || found == testimony.ticks.begin()) {
    judgement.verdict = Verdict::kTooLate;
    return judgement;
  }
  // The chains already differ before this tick: this PC missed one.
  if (std::prev(found)->digest.chain != suspicion.before.digest.chain) return judgement;
  const State here = stepped(params, actions, suspicion.before, found->inputs);
  const auto differs = record::compare_digests(found->digest, here.digest);
  if (!differs) {
    divergence.fields = record::diff_fields(found->inputs, suspicion.inputs);
    return judgement;
  }
  judgement.verdict = Verdict::kDifference;
  divergence.stage = differs->stage;
  divergence.left_digest = differs->left_digest;
  divergence.right_digest = differs->right_digest;
  name_fields(divergence, params, actions, here, testimony,
              static_cast<std::size_t>(found - testimony.ticks.begin()) + 1);
  return judgement;
}

bool Check::take_actions(int count) {
  actions_ = count == 0 ? action::Library{} : own_;
  if (count == 0 || count == own_.count()) return true;
  refuse(
      fmt::format("the controller has {} actions, and {} has {} here: in a fall both would play "
                  "others; write them anew, verp flash --params, or bring the files back",
                  count, params_.name, own_.count()));
  return false;
}

bool Check::step_on(const Inputs& inputs, std::uint64_t digest) {
  verp::State next = shadow_;
  Outputs outputs;
  step(params_, actions_, next, inputs, outputs);
  if (next.digest.chain != digest) return false;
  shadow_ = next;
  ++compared_;
  if (++clean_ == kClean) misheard_ = 0;
  return true;
}

void Check::conclude(const Suspicion& suspicion, const char* misheard) {
  const Judgement judgement = judge(params_, actions_, suspicion, testimony_);
  divergence_ = judgement.divergence;
  if (judgement.verdict == Verdict::kDifference ||
      (judgement.verdict == Verdict::kMisheard && ++misheard_ > kMostMisheard)) {
    state_ = State::kDiffers;
  } else if (judgement.verdict == Verdict::kTooLate) {
    ++unsettled_;
    lose("a digest differed, and the controller's records of that tick came too late");
  } else {
    lose(misheard);
  }
}

void Check::lose(const std::string& why) {
  ++gaps_;
  gap_ = why;
  clean_ = 0;
  if (state_ != State::kRefused) state_ = State::kAsking;
}

void Check::refuse(const std::string& why) {
  refusal_ = why;
  state_ = State::kRefused;
}

}  // namespace verp::shadow
