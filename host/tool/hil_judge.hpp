#pragma once
#include <fmt/format.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "host/bus/operator_port.hpp"
#include "host/session/robot.hpp"
#include "host/tool/interrupt.hpp"

namespace verp::tool {

/// What a controller in lockstep does, whatever bus brings it: orders go to its operator's port if
/// that is known, and each of its ticks is held against this PC's. `Bus` is the twin's, `Shadow`
/// the controller once more on what crossed it.
template <class Bus, class Shadow>
class HilJudge {
 public:
  using Say = std::function<void(const std::string&)>;

  /// `operator_link` may be empty: then somebody else gives orders, and only the twin is watched,
  /// by `watch`. The references must outlive the judge.
  HilJudge(const session::WalkPlan& plan, session::Robot& robot, Bus& bus,
           const std::string& operator_link, Say say, std::function<void()> watch)
      : plan_(plan), robot_(robot), bus_(bus), say_(std::move(say)), watch_(std::move(watch)) {
    if (operator_link.empty()) return;
    orders_.emplace(operator_link, [] { return interrupted(); });
    begin_shadow();
  }
  HilJudge(const HilJudge&) = delete;
  HilJudge& operator=(const HilJudge&) = delete;

  /// Null without an operator's port.
  Shadow* shadow() { return shadow_ ? &*shadow_ : nullptr; }
  bool shadows() const { return shadow_.has_value(); }
  const std::string& failure() const { return failure_; }
  bool device_trouble() const { return device_trouble_; }
  std::uint64_t compared() const { return compared_; }
  std::uint32_t resets() const { return resets_; }

  void fail(const std::string& why, bool device = true) {
    if (!failure_.empty()) return;
    failure_ = why;
    device_trouble_ = device;
  }

  /// A controller greets, for the first time or again.
  void greeted(bool first) {
    if (first) return say_("a controller has come, in lockstep");
    if (!bus_.ticking()) return say_("the controller greets again");
    ++resets_;
    say_(fmt::format(
        "the controller began anew at {:.2f} s; the servos hold what they were told last",
        robot_.simulated_s()));
    pass_restart();
    if (!shadow_) return;
    // What it knew is gone, and with it what this PC knew of it.
    recorded_ = false;
    begin_shadow();
    robot_.begin_anew();
  }

  /// False: no further tick.
  bool tick_ends() {
    if (!shadow_) {
      if (bus_.ticking()) watch_();
      return !robot_.over();
    }
    shadow_->catch_up();
    if (!shadow_->difference().empty()) {
      fail("not the same bits: " + shadow_->difference(), false);
    }
    if (robot_.over()) compare(orders_->exchange(nullptr));
    return failure_.empty() && !robot_.over();
  }

  // The controller waits for the answer that begins its tick, and serves its operator meanwhile:
  // what is written now, it takes in this very tick.
  void tick_begins(std::uint32_t tick) {
    if (!shadow_) return;
    const app::OperatorOrder order = robot_.order(tick);
    const bool news = order.flags != 0;
    compare(orders_->exchange(news ? &order : nullptr));
    if (news) shadow_->ordered(order);
  }

 private:
  /// What a start takes by the twin's clock: reset, boot check, greeting.
  static constexpr std::uint32_t kRestart_us = 1'000'000;

  void begin_shadow() {
    shadow_.emplace(plan_.params,
                    [this](const TickRecord& tick, const State& state, const Outputs& outputs) {
                      robot_.record(tick, state, outputs);
                      last_ = {tick.inputs.tick, tick.digest.chain};
                      recorded_ = true;
                    });
  }

  // In lockstep no time goes by while a controller is away; on a robot it does, and the servos'
  // watchdogs see it.
  void pass_restart() { bus_.let_pass(bus_.now_us() + kRestart_us); }

  void compare(const bus::ControllerReport& told) {
    if (!recorded_ || told.tick != last_.tick) return;
    if (told.digest == last_.digest) {
      ++compared_;
      return;
    }
    fail(fmt::format("not the same bits: at tick {} the controller's digest is 0x{:016x}, this "
                     "PC's 0x{:016x}",
                     last_.tick, told.digest, last_.digest),
         false);
  }

  const session::WalkPlan& plan_;
  session::Robot& robot_;
  Bus& bus_;
  Say say_;
  std::function<void()> watch_;
  std::optional<bus::OperatorPort> orders_;
  std::optional<Shadow> shadow_;
  bus::ControllerReport last_;
  bool recorded_ = false;
  bool device_trouble_ = false;
  std::string failure_;
  std::uint64_t compared_ = 0;
  std::uint32_t resets_ = 0;
};

}  // namespace verp::tool
