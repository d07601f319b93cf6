#include "host/author/action/let_go.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/author/action/get_up.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/session/fall_story.hpp"
#include "host/run/session/fall_verdict.hpp"
#include "host/run/session/session.hpp"
#include "host/twin/sim/vary.hpp"

namespace verp::action {
namespace {

using safety::Mode;

constexpr double kStands_s = 0.5;   // before it is asked to relax
constexpr double kWatched_s = 2.0;  // a crouch that tips over lies after 1.5 s
constexpr double kTimeOut_s = 90;   // a rise, a sitting and an action
constexpr double kLies_rad = 1.0;   // where the twin counts a fall
constexpr double kStill_rad = 0.3;  // limbs settle

double tilt_of(const sim::Truth& truth) {
  return std::acos(std::clamp(truth.body_world.linear()(2, 2), -1.0, 1.0));
}

/// Asks a robot to stand, then to relax, and watches how it comes down.
class Watch {
 public:
  explicit Watch(double period_s) : period_s_(period_s) {}

  app::OperatorOrder order() {
    app::OperatorOrder order;
    ++command_.sequence;
    command_.request = stood_s_ < kStands_s ? Request::kStand : Request::kRelax;
    order.command = command_;
    order.flags = kCommandFresh;
    return order;
  }

  void see(const session::Tick& tick) {
    if (tick.outputs == nullptr) return;
    run_s_ += period_s_;
    const auto mode = static_cast<Mode>(tick.outputs->mode);
    if (mode == Mode::kStanding) stood_s_ += period_s_;
    result_.by_action = result_.by_action || mode == Mode::kLyingDown;
    const sim::Truth& truth = tick.seen.truth;
    const double tilt_rad = tilt_of(truth);
    descent_.see(tilt_rad, truth.com_world_m.z(), truth.com_velocity_world_m_s.z());
    up_ = truth.body_world.linear().row(2);
    if (stood_s_ < kStands_s || tick.outputs->torque_enable != 0) {
      before_rad_ = tilt_rad;
      return;
    }
    limp_s_ += period_s_;
    const bool falls = tilt_rad > kLies_rad && before_rad_ < kLies_rad;
    if (falls && result_.fell_s <= 0) result_.fell_s = limp_s_;
    result_.moved_rad = std::max(result_.moved_rad, std::abs(tilt_rad - before_rad_));
    tilt_rad_ = tilt_rad;
  }

  bool over() const { return limp_s_ > kWatched_s || run_s_ > kTimeOut_s; }

  LetGo result(double gravity_m_s2) {
    result_.tried = limp_s_ > kWatched_s;
    result_.lay_rad = before_rad_;
    result_.down_m_s = descent_.fastest_m_s();
    result_.fall_percent = 100 * descent_.fall_share(gravity_m_s2);
    const bool lies = tilt_rad_ > kLies_rad;
    result_.ends = lies ? "lies " + session::how_it_lies(up_.x(), up_.y()) : "stays upright";
    const bool lay = before_rad_ > kLies_rad;
    result_.good =
        result_.moved_rad < kStill_rad && lay == lies && (!lies || descent_.gentle(gravity_m_s2));
    return result_;
  }

 private:
  const double period_s_;
  Command command_;
  double run_s_ = 0, stood_s_ = 0, limp_s_ = 0;
  double before_rad_ = 0, tilt_rad_ = 0;
  sim::Vec3 up_ = sim::Vec3::UnitZ();
  session::Descent descent_;
  LetGo result_;
};

}  // namespace

std::string LetGo::words(const std::string& robot) const {
  if (!tried) return "not tried: it has no legs, or does not stand in the twin";
  if (good && by_action) return fmt::format("by its action lie_down: it {}", ends);
  if (good) return "in the crouch: it " + ends;
  return fmt::format("{} it falls, {:.0f} degrees, and {}. Hold it when it lets go, or {}",
                     by_action ? "by its action lie_down" : "in the crouch",
                     180 / std::numbers::pi * moved_rad, ends,
                     by_action ? "change its action lie_down (manual: actions)"
                               : "give it an action lie_down: `verp action make lie_down " + robot +
                                     "` looks for one");
}

LetGo let_go(session::WalkPlan plan, const sim::WorldOptions& world) {
  take_lie_down(plan);
  Watch watch(1e-6 * plan.params.period_us);
  session::Options options;
  options.world = world;
  session::Hooks hooks;
  hooks.order = [&](std::uint32_t) { return watch.order(); };
  hooks.ticked = [&](const session::Tick& tick) { watch.see(tick); };
  hooks.open_end = true;
  session::Session session(std::move(options));
  session.add(plan, std::move(hooks));
  while (!watch.over() && session.tick() != nullptr) {
  }
  return watch.result(world.gravity_m_s2);
}

LetGo let_go(const model::Entity& entity) {
  if (model::find_limb(entity, "left_leg") == nullptr) return {};
  session::WalkPlan plan;
  plan.entity = entity;
  plan.params = model::make_params(entity);
  for (model::Joint& joint : plan.entity.joints) sim::scale_friction(-1, joint.servo);
  sim::WorldOptions world;
  world.step_us = 2000;
  return let_go(std::move(plan), world);
}

}  // namespace verp::action
