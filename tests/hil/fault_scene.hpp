#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/hil/promises.hpp"
#include "tests/hil/run_body.hpp"
#include "tests/hil/run_watch.hpp"
#include "tests/hil/software_board.hpp"

namespace verp::test {

/// A robot stands up, walks and meets a fault. Each bus adds its line, faults and checks.
template <class Line, class Plan, class Result>
class FaultScene {
 public:
  virtual ~FaultScene() = default;

  Result run() {
    if (begin_walk()) {
      start_m_ = body_.position_m();
      begin();
      const double lasts_s = plan_.lasts_s > 0 ? plan_.lasts_s : plan_.walks_s;
      spend(lasts_s);
      result_.during = read_registers(desk_);
      result_.changes = changes_;
      end();
      body_.plant().cure();
      sags_ = false;
      if (is_trouble()) relax(0.5);
      spend(plan_.walks_s - lasts_s);
      result_.after = read_registers(desk_);
    }
    keep();
    result_.distance_m = (body_.position_m() - start_m_).norm();
    result_.fallen = body_.fallen();
    finish();
    result_.violation = watch_.violation();
    return result_;
  }

 protected:
  using Event = decltype(Plan::event);
  using ResetCause = dxl::controller::ResetCause;

  /// The fault comes up to half a second after `first_steps_s`.
  FaultScene(const Robot& robot, const Plan& plan, std::uint32_t seed, double first_steps_s)
      : params_(robot.params),
        plan_(plan),
        random_(seed + 1),
        body_(robot, plan.physics, seed),
        watch_(params_, body_.plant()),
        first_steps_s_(first_steps_s) {
    result_.joint = static_cast<int>(random_() % params_.joint_count);
  }

  virtual Line& line() = 0;
  virtual void begin() = 0;  ///< the fault
  virtual void end() = 0;
  virtual void watched_tick() = 0;
  virtual void finish() = 0;
  virtual void disturb() {}
  /// For a restarted controller's ticks; may be null.
  virtual std::vector<TickRecord>* trace() { return nullptr; }

  double seconds(std::uint64_t ticks) const {
    return 1e-6 * static_cast<double>(ticks * params_.period_us);
  }
  void fault(const std::string& what) { watch_.fault(what); }
  /// In this tick of a fault that flutters.
  bool is_mute() const { return result_.ticks * params_.period_us % 300'000 < 70'000 && !ended(); }
  bool ended() const { return plan_.lasts_s > 0 && seconds(result_.ticks) >= plan_.lasts_s; }

  void begin_in_plant() {
    switch (plan_.event) {
      case Event::kRepeats:
        // A walk moves knees and hips.
        result_.joint = params_.leg[random_() % kFeet].joint[2 + random_() % 3];
        return body_.plant().freeze(result_.joint);
      case Event::kHot:
        return body_.plant().heat(result_.joint, kHot_c);
      case Event::kOverheated:
        return body_.plant().heat(result_.joint, kTooHot_c);
      case Event::kLowVoltage:
        return body_.plant().sag_to(kLow_v);
      case Event::kSags:
        sags_ = true;
        return;
      case Event::kJointBeyond:
        return bend();
      case Event::kImuRepeats:
        return body_.plant().freeze_imu();
      default:
        return;
    }
  }

  // The chip's start and boot check serve nothing.
  void restart() {
    keep();
    line().wait_until(line().time_us() + 150'000 + random_() % 850'000);
    power_up(ResetCause::kWatchdog);
    expect_held();
    desk_.write(app::reg("request"), {0});
  }

  const Params& params_;
  const Plan& plan_;
  std::minstd_rand random_;
  RunBody body_;
  RunWatch watch_;
  OperatorDesk desk_;
  std::unique_ptr<ControllerOnBoard<Line>> board_;
  Result result_;

 private:
  static constexpr std::uint32_t kOrderTicks = 10;
  static constexpr double kUpright_s = 8;  // standing up and learning the gyro's bias end earlier
  static constexpr double kHot_c = 76;     // above temperature_high_c, below a shutdown
  static constexpr double kTooHot_c = 90;  // above the servo's limit of 80
  static constexpr double kDown_s = 4;     // ending a walk and sitting down take less
  static constexpr double kLow_v = 9.5;    // below voltage_low_v, not the servo's limit

  bool walks() const { return board_->safe.mode() == kWalking; }
  void keep() {
    result_.seen |= board_->safe.seen();
    if (!board_->safe.violation().empty()) fault(board_->safe.violation());
  }

  bool power_up(ResetCause cause) {
    board_.reset();
    board_ = std::make_unique<ControllerOnBoard<Line>>(params_, line(), desk_, cause, trace());
    const app::BringUpReport report = board_->loop.bring_up();
    board_->pacer.start(params_.period_us);
    if (report.status == app::BringUpStatus::kReady) return true;
    fault("device " + std::to_string(report.device_id) + " did not come up");
    return false;
  }
  bool begin_walk() {
    if (!power_up(ResetCause::kPower)) return false;
    desk_.write(app::reg("request"), {0});
    const double walk_s = first_steps_s_ + 1e-3 * static_cast<double>(random_() % 500);
    std::uint64_t walked = 0;
    for (std::uint64_t ticks = 0; seconds(walked) < walk_s; ++ticks) {
      if (seconds(ticks) >= kUpright_s) {
        fault("the robot did not walk before the fault");
        return false;
      }
      tick();
      walked += walks() ? 1 : 0;
    }
    result_.ready = true;
    result_.before = read_registers(desk_);
    return true;
  }
  /// After a reset, repeated orders must not raise the robot before an order to relax.
  void expect_held() {
    for (int ticks = 0; ticks < 50; ++ticks) {
      if (desk_.order_walk(ticks_)) fault("an order from before the reset was taken");
      board_->tick();
      if (board_->loop.outputs().torque_enable != 0) fault("the robot rose unasked");
    }
  }

  /// Latched until a relaxed robot is asked to relax.
  bool is_trouble() const {
    return plan_.event == Event::kHot || plan_.event == Event::kLowVoltage ||
           plan_.event == Event::kSags || plan_.event == Event::kFlutters;
  }
  void relax(double duration_s) {
    asks_ = false;
    desk_.write(app::reg("request"), {0});
    for (std::uint64_t ticks = 0; seconds(ticks) < duration_s; ++ticks) tick();
    asks_ = true;
  }
  /// A hand turns a limp robot's joint beyond its limits.
  void bend() {
    relax(kDown_s);
    const JointParams& joint = params_.joint[result_.joint];
    const float way_rad = joint.upper_rad - joint.lower_rad + 0.2F;
    result_.joint_id = joint.servo_id;
    body_.plant().bend(result_.joint, static_cast<std::int32_t>(joint.counts_per_rad * way_rad));
  }

  void spend(double duration_s) {
    for (std::uint64_t ticks = 0; seconds(ticks) < duration_s; ++ticks) {
      if (plan_.event == Event::kLateLoop && random_() % 25 == 0) {
        ++result_.events;
        line().wait_until(line().time_us() + 15'000 + random_() % 25'000);
        late_us_ = line().time_us();
      }
      disturb();
      const int before = board_->safe.mode();
      tick();
      changes_ += board_->safe.mode() != before ? 1 : 0;
      ++result_.ticks;
      result_.walking_ticks += walks() ? 1 : 0;
    }
  }
  void tick() {
    if (ticks_++ % kOrderTicks == 0 && asks_) desk_.order_walk(ticks_);
    if (sags_) body_.plant().sag_to(walks() ? kLow_v : 0);
    const std::uint64_t due_us = board_->clock.due_us();
    watched_tick();
    const std::uint64_t begun_us = std::max(due_us, late_us_);
    result_.worst_tick_us = std::max(result_.worst_tick_us, line().time_us() - begun_us);
  }

  const double first_steps_s_;
  Eigen::Vector2d start_m_ = Eigen::Vector2d::Zero();
  std::uint64_t late_us_ = 0;  ///< when the busy loop resumed
  std::uint32_t ticks_ = 0;
  std::uint32_t changes_ = 0;  ///< of mode, since the fault
  bool asks_ = true;
  bool sags_ = false;
};

}  // namespace verp::test
