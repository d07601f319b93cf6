#include "host/action/play.hpp"

#include "common/safety/machine.hpp"

namespace verp::action {
namespace {

constexpr double kSettle_s = 0.5, kStandUp_s = 15, kMostAction_s = 300;
constexpr std::uint32_t kFrameTicks = 10;  // as any operator's

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
    // The bias of the gyro is known by then.
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

Played play(session::WalkPlan plan, int number, session::Hooks hooks, session::Options options) {
  constexpr double kLongest_s = 2 * (kStandUp_s + kMostAction_s);
  plan.walk_s = kLongest_s;
  PlayOperator person(number, 1e-6 * plan.params.period_us);
  Played played;
  hooks.order = [&](std::uint32_t tick) { return person.order(tick); };
  hooks.ticked = [&, also = hooks.ticked](const session::Tick& tick) {
    if (tick.state != nullptr) person.observe(*tick.state, *tick.outputs);
    if (person.played_s() == 0) played.asked_s = tick.seen.truth.t_s;
    if (also) also(tick);
  };
  session::Session session(std::move(options));
  session.add(plan, std::move(hooks));
  while (!person.done() && session.tick() != nullptr) {
  }
  played.run = session.result(0);
  played.action_s = person.played_s();
  if (played.run.good() && person.failed()[0] != '\0') played.run.failure = person.failed();
  return played;
}

}  // namespace verp::action
