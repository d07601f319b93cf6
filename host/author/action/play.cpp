#include "host/author/action/play.hpp"

#include <cmath>
#include <numbers>

#include "host/author/action/play_operator.hpp"

namespace verp::action {
namespace {

/// The way on the floor, in the heading of `from`.
void tell_way(const sim::Truth& from, const sim::Truth& to, PlayedAction& played) {
  const Eigen::Rotation2Dd home(-from.yaw_rad);
  played.went_m = home * (to.body_world.translation() - from.body_world.translation()).head<2>();
  played.turned_rad = std::remainder(to.yaw_rad - from.yaw_rad, 2 * std::numbers::pi);
}

constexpr double kLongest_s = 2 * (PlayOperator::kStandUp_s + PlayOperator::kMostAction_s);

}  // namespace

PlayedAction play(session::WalkPlan plan, int number, session::Hooks hooks,
                  session::Options options) {
  plan.walk_s = kLongest_s;
  PlayOperator person(number, 1e-6 * plan.params.period_us);
  PlayedAction played;
  sim::Truth from;
  hooks.order = [&](std::uint32_t tick) { return person.order(tick); };
  hooks.ticked = [&, also = hooks.ticked](const session::Tick& tick) {
    if (tick.state != nullptr) person.observe(*tick.state, *tick.outputs);
    if (person.played_s() == 0) {
      played.asked_s = tick.seen.truth.t_s;
      from = tick.seen.truth;
    } else if (!person.done()) {
      tell_way(from, tick.seen.truth, played);
    }
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
