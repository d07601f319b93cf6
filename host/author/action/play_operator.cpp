#include "host/author/action/play_operator.hpp"

#include "common/safety/machine.hpp"

namespace verp::action {
namespace {

constexpr double kSettle_s = 0.5;
constexpr std::uint32_t kFrameTicks = 10;  // as in every operator's radio

bool is_in(const Outputs& outputs, safety::Mode mode) {
  return outputs.mode == static_cast<std::uint8_t>(mode);
}

}  // namespace

app::OperatorOrder PlayOperator::order(std::uint32_t tick) {
  app::OperatorOrder order;
  if (tick % kFrameTicks == 0 || changed_) {
    ++command_.sequence;
    order.flags = kCommandFresh;
  }
  changed_ = false;
  command_.request = Request::kStand;
  order.command = command_;
  order.action = static_cast<std::uint16_t>(asked_ ? number_ : 0);
  return order;
}

void PlayOperator::observe(const State& state, const Outputs& outputs) {
  stood_s_ = is_in(outputs, safety::Mode::kStanding) ? stood_s_ + period_s_ : 0;
  if (state.action.number != 0) played_s_ += period_s_;
  if (!asked_) {
    // Now the gyro's bias is known.
    if (stood_s_ >= kSettle_s && state.attitude.still_s >= balance::kCalibrated_s) {
      asked_ = changed_ = true;
      stood_s_ = waited_s_ = 0;
    }
    waited_s_ += period_s_;
    if (waited_s_ > kStandUp_s) failed_ = "the robot did not stand", done_ = true;
    return;
  }
  if (played_s_ > 0 && stood_s_ >= kSettle_s) done_ = true;
  if (played_s_ == 0 && stood_s_ > kStandUp_s) failed_ = "the action did not begin", done_ = true;
  if (played_s_ > kMostAction_s) failed_ = "the action does not end", done_ = true;
}

}  // namespace verp::action
