#include "host/apps/tool/robot/run_operator.hpp"

#include <fmt/format.h>

#include <utility>

#include "host/run/session/fault_names.hpp"

namespace verp::tool {

using safety::Mode;

RunOperator::RunOperator(const Params& params, const Command& velocity, double walk_s, Told told,
                         int get_ups, bool stands)
    : params_(params),
      walker_(params, velocity, walk_s, get_ups, stands),
      told_(std::move(told)),
      period_s_(1e-6 * params.period_us),
      most_s_(walk_s),
      gets_up_(get_ups > 0),
      story_(get_ups) {}

app::OperatorOrder RunOperator::order(std::uint32_t tick) {
  app::OperatorOrder order = wish(tick);
  if (stop_ != nullptr && stop_->pressed()) order.flags |= kEmergencyStop;
  return order;
}

app::OperatorOrder RunOperator::wish(std::uint32_t tick) {
  if (!sitting_ && !limp_) {
    return orders_ ? orders_(tick) : player_ ? player_->order(tick) : walker_.order(tick);
  }
  app::OperatorOrder order;
  relax_.request = Request::kRelax;
  ++relax_.sequence;
  order.command = relax_;
  order.flags = kCommandFresh;
  if (limp_) order.flags |= kEmergencyStop;
  return order;
}

void RunOperator::fail(const std::string& why) {
  if (failure_.empty()) failure_ = why;
  sitting_ = true;
}

// Another source of orders may release torque: no failure.
void RunOperator::observe_obeying(std::uint32_t faults) {
  constexpr std::uint32_t kStopping = 0xFFFF;
  obeyed_s_ += period_s_;
  if (mode_ == Mode::kWalking) walked_s_ += period_s_;
  if (mode_ == Mode::kRelaxed && risen_ && (faults & kStopping) != 0) {
    fail(session::why_it_let_go(faults));
  }
  if (obeyed_s_ >= most_s_) sitting_ = true;
}

void RunOperator::observe_playing(const State& state, const Outputs& outputs) {
  player_->observe(state, outputs);
  if (player_->done()) fail(player_->failed());
}

// With get-ups, the walker counts the attempts.
void RunOperator::observe_mode(Mode from, const State& state, const Outputs& outputs) {
  const std::string story = story_.observe(state, outputs);
  if (mode_ != from && mode_ == Mode::kHolding)  // a caught fall holds without a silence
    silent_ = from == Mode::kFalling ? "" : session::silent_device(params_, state);
  const bool holds = from == Mode::kHolding || mode_ == Mode::kHolding;
  if (mode_ != from) told_(from, mode_, outputs.faults, story, holds ? silent_ : "");
  risen_ = risen_ || outputs.torque_enable != 0;
  if (mode_ == Mode::kFallen && !gets_up_) fail("the robot fell");
  if (mode_ == Mode::kStopped && !limp_) {
    const bool here = stop_ != nullptr && stop_->is_pressed();
    fail(here ? "stopped by the button at " + stop_->name() : "stopped");
  }
  if (mode_ == Mode::kRelaxed && risen_ && !sitting_ && !orders_) {
    fail(session::why_it_let_go(outputs.faults));
  }
}

void RunOperator::observe(const State& state, const Outputs& outputs) {
  const auto mode = static_cast<Mode>(outputs.mode);
  observe_mode(std::exchange(mode_, mode), state, outputs);
  // Automatic actions do not use up the operator's patience.
  const bool by_itself = mode == Mode::kHolding || mode == Mode::kSitting ||
                         (mode == Mode::kRising && walker_.walked_s() > 0);
  if (orders_ && !sitting_) {
    observe_obeying(outputs.faults);
  } else if (!sitting_ && !by_itself && player_) {
    observe_playing(state, outputs);
  } else if (!sitting_ && !by_itself) {
    walker_.observe(state, outputs);
    if (walker_.done()) {
      failure_ = walker_.failed();
      sitting_ = true;
    }
  }
  const bool ending = sitting_ || limp_;
  quiet_ticks_ = ending && outputs.torque_enable == 0 ? quiet_ticks_ + 1 : 0;
  ending_.observe(state, outputs, period_s_);
  if (ending && !limp_ && ending_.fell()) {
    fail(
        fmt::format("{:.1f} s after torque went off it fell and {}: hold it at the end, or give "
                    "it an action lie_down (verp action make)",
                    ending_.fell_s(), ending_.words()));
  }
}

}  // namespace verp::tool
