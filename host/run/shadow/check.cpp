#include "host/run/shadow/check.hpp"

#include <fmt/format.h>

#include "common/control/step.hpp"

namespace verp::shadow {

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
