#include "tests/hil/fault_run.hpp"

#include <algorithm>
#include <memory>

#include "tests/hil/run_body.hpp"
#include "tests/hil/run_watch.hpp"
#include "tests/hil/software_board.hpp"

namespace verp::test {
namespace {

namespace table = dxl::controller;
using app::reg;

constexpr std::uint8_t kWalking = 3;
constexpr std::uint32_t kOrderTicks = 10;
constexpr double kUpright_s = 8;       // standing up and learning the gyro's bias take less
constexpr double kFirstSteps_s = 1.2;  // of walking before the fault
constexpr double kHot_c = 76;          // beyond temperature_high_c, below a shutdown
constexpr double kTooHot_c = 90;       // beyond the servo's own limit, 80
constexpr double kDown_s = 4;          // ending a walk and sitting down take less
constexpr double kLow_v = 9.5;         // below voltage_low_v, not below the servo's own

class FaultRun {
 public:
  FaultRun(const Robot& robot, const FaultPlan& plan, std::uint32_t seed)
      : params_(robot.params),
        plan_(plan),
        random_(seed + 1),
        body_(robot, plan.physics, seed),
        watch_(params_, body_.plant()),
        bus_(params_, body_.plant()),
        line_(bus_, seed) {
    result_.joint = static_cast<int>(random_() % params_.joint_count);
  }

  FaultResult run() {
    if (!power_up(table::ResetCause::kPower)) return unready();
    desk_.write(reg("request"), {0});
    const double walk_s = kFirstSteps_s + 1e-3 * static_cast<double>(random_() % 500);
    if (!walk_for(walk_s)) return unready();
    result_.ready = true;
    result_.before = registers();
    start_m_ = body_.position_m();
    begin();
    const double lasts_s = plan_.lasts_s > 0 ? plan_.lasts_s : plan_.walks_s;
    spend(lasts_s);
    result_.during = registers();
    result_.changes = changes_;
    end();
    spend(plan_.walks_s - lasts_s);
    finish();
    return result_;
  }

 private:
  FaultResult unready() {
    result_.violation = watch_.violation();
    return result_;
  }
  double seconds(std::uint64_t ticks) const {
    return 1e-6 * static_cast<double>(ticks * params_.period_us);
  }

  bool power_up(table::ResetCause cause) {
    controller_.reset();
    controller_ = std::make_unique<Controller>(params_, line_, desk_, cause);
    const app::BringUpReport report = controller_->loop.bring_up();
    controller_->pacer.start(params_.period_us);
    if (report.status == app::BringUpStatus::kReady) return true;
    fault("device " + std::to_string(report.device_id) + " did not come up");
    return false;
  }

  bool walk_for(double duration_s) {
    std::uint64_t walked = 0;
    for (std::uint64_t ticks = 0; seconds(ticks) < kUpright_s; ++ticks) {
      tick();
      walked += controller_->safe.mode() == kWalking ? 1 : 0;
      if (seconds(walked) >= duration_s) return true;
    }
    fault("the robot did not walk before the fault");
    return false;
  }

  void begin() {
    line_.faults = plan_.line;
    switch (plan_.event) {
      case Event::kServoGone:
        ++result_.events;
        bus_.set_connected(params_.joint[result_.joint].servo_id, false);
        break;
      case Event::kServoUnpowered:
        ++result_.events;
        bus_.set_powered(params_.joint[result_.joint].servo_id, false);
        unready_ = true;
        break;
      case Event::kServoRepeats:
        ++result_.events;
        // A knee or a hip: what walks must move.
        result_.joint = params_.leg[random_() % kFeet].joint[2 + random_() % 3];
        body_.plant().freeze(result_.joint);
        break;
      case Event::kReset:
        ++result_.events;
        restart();
        break;
      case Event::kHot:
      case Event::kOverheated:
        ++result_.events;
        body_.plant().heat(result_.joint, plan_.event == Event::kHot ? kHot_c : kTooHot_c);
        break;
      case Event::kLowVoltage:
        ++result_.events;
        body_.plant().sag_to(kLow_v);
        break;
      case Event::kSags:
        ++result_.events;
        sags_ = true;
        break;
      case Event::kJointBeyond:
        ++result_.events;
        bend();
        break;
      case Event::kImuGone:
        ++result_.events;
        bus_.set_connected(params_.imu.device_id, false);
        break;
      case Event::kImuRepeats:
        ++result_.events;
        body_.plant().freeze_imu();
        break;
      default:
        break;
    }
  }

  void end() {
    line_.faults = {};
    if (plan_.event == Event::kServoGone) {
      if (plan_.lasts_s > 0) bus_.set_connected(params_.joint[result_.joint].servo_id, true);
    }
    if (plan_.event == Event::kServoUnpowered && plan_.lasts_s > 0) {
      bus_.set_powered(params_.joint[result_.joint].servo_id, true);
    }
    if (plan_.event == Event::kImuGone) bus_.set_connected(params_.imu.device_id, true);
    body_.plant().cure();
    sags_ = false;
    if (is_trouble()) relax(0.5);
  }

  // The chip's start and its boot check take their time; the servos hear nothing meanwhile.
  void restart() {
    keep(controller_->safe);
    line_.wait_until(line_.now_us() + 150'000 + random_() % 850'000);
    power_up(table::ResetCause::kWatchdog);
    expect_held();
    desk_.write(reg("request"), {0});
  }

  /// What is latched until somebody asks a relaxed robot to relax.
  bool is_trouble() const {
    return plan_.event == Event::kHot || plan_.event == Event::kLowVoltage ||
           plan_.event == Event::kSags;
  }
  /// Nobody asks for more than to relax.
  void relax(double duration_s) {
    asks_ = false;
    desk_.write(reg("request"), {0});
    for (std::uint64_t ticks = 0; seconds(ticks) < duration_s; ++ticks) tick();
    asks_ = true;
  }
  /// A limp robot's joint is turned by hand, further than it should ever go.
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
        line_.wait_until(line_.now_us() + 15'000 + random_() % 25'000);
        late_us_ = line_.now_us();
      }
      const int before = controller_->safe.mode();
      tick();
      changes_ += controller_->safe.mode() != before ? 1 : 0;
      ++result_.ticks;
      result_.walking_ticks += controller_->safe.mode() == kWalking ? 1 : 0;
    }
  }

  void tick() {
    if (ticks_++ % kOrderTicks == 0 && asks_) desk_.order_walk(ticks_);
    if (sags_) body_.plant().sag_to(controller_->safe.mode() == kWalking ? kLow_v : 0);
    const std::uint64_t due_us = controller_->clock.due_us();
    const int joint = result_.joint;
    if (body_.on_stand()) {
      line_.wait_until(due_us);
      watch_.note_positions(controller_->loop.outputs());
    }
    controller_->tick();
    const Inputs& inputs = controller_->loop.inputs();
    const Outputs& outputs = controller_->loop.outputs();
    const bool repeats = plan_.event == Event::kServoRepeats;
    if (body_.on_stand()) watch_.watch_positions(inputs, repeats ? joint : RunWatch::kNobody);
    watch_.watch_silence(inputs);
    watch_gains();
    const std::uint64_t begun_us = std::max(due_us, late_us_);
    result_.worst_tick_us = std::max(result_.worst_tick_us, line_.now_us() - begun_us);
    const bool gone = plan_.event == Event::kServoGone;
    watch_.watch_torque(outputs, line_.now_us(), line_.faults.cut,
                        gone ? joint : RunWatch::kNobody);
    watch_.watch_fall(outputs, line_.now_us(), body_.lies());
  }

  /// A program that repeats its order does not raise a robot whose controller was reset: it takes
  /// somebody who asks it to relax.
  void expect_held() {
    for (int ticks = 0; ticks < 50; ++ticks) {
      if (desk_.order_walk(ticks_)) fault("an order from before the reset was taken");
      controller_->tick();
      if (controller_->loop.outputs().torque_enable != 0) fault("the robot rose unasked");
    }
  }

  void watch_gains() {
    unready_ = unready_ && controller_->loop.outputs().torque_enable != 0;
    for (int j = 0; j < params_.joint_count; ++j) {
      const sim::ServoSetpoint& servo = body_.plant().setpoint(j);
      const ServoProfile& profile = app::profile_of(params_, j);
      if (!servo.torque_on) continue;
      if (servo.p_gain != profile.position_p_gain || servo.d_gain != profile.position_d_gain ||
          servo.profile_ms != profile.profile_ms) {
        fault("joint " + std::to_string(j) + " has torque with gains that are not its own");
      }
      if (unready_ && j == result_.joint) fault("a servo without power was thrown at its goal");
    }
  }
  Registers registers() { return read_registers(desk_); }

  void fault(const std::string& what) { watch_.fault(what); }
  void keep(const SafeTable& safe) {
    result_.seen |= safe.seen();
    if (!safe.violation().empty()) fault(safe.violation());
  }
  void finish() {
    keep(controller_->safe);
    result_.after = registers();
    result_.damage = line_.damage();
    result_.distance_m = (body_.position_m() - start_m_).norm();
    result_.violation = watch_.violation();
    result_.stale = watch_.stale();
    result_.fallen = body_.fallen();
  }

  const Params& params_;
  const FaultPlan& plan_;
  std::minstd_rand random_;
  RunBody body_;
  RunWatch watch_;
  bus::VirtualBus bus_;
  FaultyLine line_;
  OperatorDesk desk_;
  std::unique_ptr<Controller> controller_;
  FaultResult result_;
  Eigen::Vector2d start_m_ = Eigen::Vector2d::Zero();
  bool unready_ = false;       ///< result_.joint lost its power, and the robot has not let go since
  std::uint64_t late_us_ = 0;  ///< when the loop came back from being busy elsewhere
  std::uint32_t ticks_ = 0;
  std::uint32_t changes_ = 0;  ///< of mode, since the fault began
  bool asks_ = true;           ///< the operator repeats its order to walk
  bool sags_ = false;          ///< the supply, while the robot walks
};

}  // namespace

FaultResult run_fault(const Robot& robot, const FaultPlan& plan, std::uint32_t seed) {
  return FaultRun(robot, plan, seed).run();
}

}  // namespace verp::test
