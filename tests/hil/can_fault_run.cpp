#include "tests/hil/can_fault_run.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/protocol/canopen/robot_plan.hpp"
#include "host/record/replay.hpp"
#include "tests/hil/chip_line.hpp"
#include "tests/hil/promises.hpp"
#include "tests/hil/run_body.hpp"
#include "tests/hil/run_watch.hpp"
#include "tests/hil/software_board.hpp"

namespace verp::test {
namespace {

namespace table = dxl::controller;
using app::reg;

constexpr std::uint32_t kOrderTicks = 10;
constexpr double kUpright_s = 8;       // standing up and learning the gyro's bias take less
constexpr double kFirstSteps_s = 0.6;  // of walking before the fault
constexpr double kHot_c = 76;          // beyond temperature_high_c, below a shutdown
constexpr double kTooHot_c = 90;       // beyond the drive's own limit, 80
constexpr double kDown_s = 4;          // ending a walk and sitting down take less
constexpr double kLow_v = 9.5;         // below voltage_low_v, not below the drive's own
constexpr unsigned kOneBusOff = 33;    // ISO 11898-1: 32 errors of 8 points each, and no more
constexpr unsigned kManyErrors = 1'000'000;

template <class Line>
class CanFaultRun {
 public:
  CanFaultRun(const Robot& robot, const CanPlan& plan, std::uint32_t seed)
      : params_(robot.params),
        plan_(plan),
        random_(seed + 1),
        body_(robot, plan.physics, seed),
        watch_(params_, body_.plant()),
        bus_(params_, body_.plant()) {
    auto intruder = std::make_unique<Intruder>(params_, seed);
    intruder_ = intruder.get();
    bus_.plug_in(std::move(intruder));
    line_.emplace(bus_, seed);
    result_.joint = static_cast<int>(random_() % params_.joint_count);
  }

  CanFaultResult run() {
    if (begin_walk()) {
      start_m_ = body_.position_m();
      begin();
      const double lasts_s = plan_.lasts_s > 0 ? plan_.lasts_s : plan_.walks_s;
      spend(lasts_s);
      result_.during = read_registers(desk_);
      result_.changes = changes_;
      end();
      spend(plan_.walks_s - lasts_s);
      result_.after = read_registers(desk_);
    }
    finish();
    return result_;
  }

 private:
  using Board = ControllerOnBoard<Line>;
  static constexpr bool kChip = std::is_same_v<Line, ChipLine>;

  double seconds(std::uint64_t ticks) const {
    return 1e-6 * static_cast<double>(ticks * params_.period_us);
  }
  std::uint8_t node(int joint) const { return params_.joint[joint].servo_id; }
  void fault(const std::string& what) { watch_.fault(what); }
  void keep() {
    result_.seen |= board_->safe.seen();
    if (!board_->safe.violation().empty()) fault(board_->safe.violation());
    result_.digest = board_->loop.state().digest.chain;
  }

  bool begin_walk() {
    if (!power_up(table::ResetCause::kPower)) return false;
    desk_.write(reg("request"), {0});
    const double walk_s = kFirstSteps_s + 1e-3 * static_cast<double>(random_() % 500);
    std::uint64_t walked = 0;
    for (std::uint64_t ticks = 0; seconds(walked) < walk_s; ++ticks) {
      if (seconds(ticks) >= kUpright_s) {
        fault("the robot did not walk before the fault");
        return false;
      }
      tick();
      walked += board_->safe.mode() == kWalking ? 1 : 0;
    }
    result_.ready = true;
    result_.before = read_registers(desk_);
    return true;
  }
  bool power_up(table::ResetCause cause) {
    board_.reset();
    traces_.emplace_back();
    board_ = std::make_unique<Board>(params_, *line_, desk_, cause, &traces_.back());
    const app::BringUpReport report = board_->loop.bring_up();
    board_->pacer.start(params_.period_us);
    if (report.status == app::BringUpStatus::kReady) return true;
    fault("device " + std::to_string(report.device_id) + " did not come up");
    return false;
  }

  void begin() {
    line_->trouble.faults = plan_.line;
    intruder_->kind = plan_.intruder;
    intruder_->joint = result_.joint;
    if (plan_.event == CanEvent::kNone) return;
    ++result_.events;
    switch (plan_.event) {
      case CanEvent::kNodeSilent:
        return bus_.set_connected(node(result_.joint), false);
      case CanEvent::kNodeUnpowered:
        unready_ |= 1u << result_.joint;
        return bus_.set_powered(node(result_.joint), false);
      case CanEvent::kNodeReboots:
      case CanEvent::kManyReboot:
        return reboot(result_.joint);
      case CanEvent::kAllReboot:
        return reboot_all();
      case CanEvent::kImuReboots:
        return reboot(params_.imu.device_id);
      case CanEvent::kFootReboots:
        return reboot(params_.feet.device_id[random_() % kFeet]);
      case CanEvent::kReset:
        return restart();
      case CanEvent::kImuGone:
        return bus_.set_connected(params_.imu.device_id, false);
      case CanEvent::kBusOff:
      case CanEvent::kBusOffs:
      case CanEvent::kShort:
        return begin_on_chip();
      default:
        return begin_in_plant();
    }
  }
  void begin_in_plant() {
    switch (plan_.event) {
      case CanEvent::kNodeRepeats:
        // A knee or a hip: what walks must move.
        result_.joint = params_.leg[random_() % kFeet].joint[2 + random_() % 3];
        return body_.plant().freeze(result_.joint);
      case CanEvent::kHot:
        return body_.plant().heat(result_.joint, kHot_c);
      case CanEvent::kOverheated:
        return body_.plant().heat(result_.joint, kTooHot_c);
      case CanEvent::kLowVoltage:
        return body_.plant().sag_to(kLow_v);
      case CanEvent::kSags:
        sags_ = true;
        return;
      case CanEvent::kJointBeyond:
        return bend();
      case CanEvent::kImuRepeats:
        return body_.plant().freeze_imu();
      default:
        return;
    }
  }
  void begin_on_chip() {
    if constexpr (kChip) {
      if (plan_.event == CanEvent::kBusOff) line_->break_own(kOneBusOff);
      if (plan_.event == CanEvent::kBusOffs) line_->break_own(kManyErrors);
      if (plan_.event == CanEvent::kShort) line_->short_circuit(true);
    }
  }

  void end() {
    line_->trouble.faults = {};
    intruder_->kind = Intruder::Kind::kSilent;
    body_.plant().cure();
    sags_ = false;
    if (is_trouble()) relax(0.5);
    if (plan_.lasts_s == 0) return;
    bus_.set_connected(node(result_.joint), true);
    bus_.set_powered(node(result_.joint), true);
    bus_.set_connected(params_.imu.device_id, true);
    if constexpr (kChip) {
      line_->break_own(0);
      line_->short_circuit(false);
    }
  }

  // A dip of its supply: it boots, and knows nothing.
  void reboot(std::uint8_t id) {
    bus_.set_powered(id, false);
    bus_.set_powered(id, true);
  }
  void reboot_all() {
    for (int j = 0; j < params_.joint_count; ++j) reboot(j);
    reboot(params_.imu.device_id);
    for (const std::uint8_t id : params_.feet.device_id) reboot(id);
  }
  void reboot(int joint) {
    reboot(node(joint));
    unready_ |= 1u << joint;
  }

  // The chip's start and its boot check take their time; drives hear nothing meanwhile.
  void restart() {
    keep();
    line_->wait_until(line_->time_us() + 150'000 + random_() % 850'000);
    power_up(table::ResetCause::kWatchdog);
    expect_held();
    desk_.write(reg("request"), {0});
  }
  /// A program that repeats its order does not raise a robot whose controller was reset: it takes
  /// somebody who asks it to relax.
  void expect_held() {
    for (int ticks = 0; ticks < 50; ++ticks) {
      if (desk_.order_walk(ticks_)) fault("an order from before the reset was taken");
      board_->tick();
      if (board_->loop.outputs().torque_enable != 0) fault("the robot rose unasked");
    }
  }

  /// What is latched until somebody asks a relaxed robot to relax.
  bool is_trouble() const {
    return plan_.event == CanEvent::kHot || plan_.event == CanEvent::kLowVoltage ||
           plan_.event == CanEvent::kSags;
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
      if (plan_.event == CanEvent::kLateLoop && random_() % 25 == 0) {
        ++result_.events;
        line_->wait_until(line_->time_us() + 15'000 + random_() % 25'000);
        late_us_ = line_->time_us();
      }
      if (plan_.event == CanEvent::kManyReboot && !ended() && random_() % 10 == 0) {
        ++result_.events;
        reboot(static_cast<int>(random_() % params_.joint_count));
      }
      const int before = board_->safe.mode();
      tick();
      changes_ += board_->safe.mode() != before ? 1 : 0;
      ++result_.ticks;
      result_.walking_ticks += board_->safe.mode() == kWalking ? 1 : 0;
    }
  }
  bool ended() const { return plan_.lasts_s > 0 && seconds(result_.ticks) >= plan_.lasts_s; }

  void tick() {
    if (ticks_++ % kOrderTicks == 0 && asks_) desk_.order_walk(ticks_);
    if (sags_) body_.plant().sag_to(board_->safe.mode() == kWalking ? kLow_v : 0);
    const std::uint64_t due_us = board_->clock.due_us();
    const bool sharp = body_.on_stand() && plan_.intruder != Intruder::Kind::kTwin;
    line_->wait_until(due_us);
    if (sharp) watch_.note_positions(board_->loop.outputs());
    board_->tick();
    watch(sharp);
    const std::uint64_t begun_us = std::max(due_us, late_us_);
    result_.worst_tick_us = std::max(result_.worst_tick_us, line_->time_us() - begun_us);
  }
  void watch(bool sharp) {
    const Inputs& inputs = board_->loop.inputs();
    const Outputs& outputs = board_->loop.outputs();
    const bool repeats = plan_.event == CanEvent::kNodeRepeats;
    const bool gone = plan_.event == CanEvent::kNodeSilent;
    const bool cut = line_->trouble.faults.down || plan_.event == CanEvent::kBusOffs ||
                     plan_.event == CanEvent::kShort || plan_.intruder == Intruder::Kind::kFlood;
    const std::uint64_t now_us = bus_.now_us();
    if (sharp) watch_.watch_positions(inputs, repeats ? result_.joint : RunWatch::kNobody);
    watch_setup(outputs);
    watch_orders(now_us);
    watch_.watch_torque(outputs, now_us, cut && !ended(), gone ? result_.joint : RunWatch::kNobody);
    watch_.watch_fall(outputs, now_us, body_.lies());
  }
  /// No drive has torque that is not set up, or has lost its power since the robot was let go.
  void watch_setup(const Outputs& outputs) {
    if (outputs.torque_enable == 0) unready_ = 0;
    for (int j = 0; j < params_.joint_count; ++j) {
      const sim::ServoSetpoint& servo = body_.plant().setpoint(j);
      const ServoProfile& profile = app::profile_of(params_, j);
      if (!servo.torque_on) continue;
      const bool held = servo.profile_ms == 0;  // quick stop: it follows nothing
      if (servo.p_gain != profile.position_p_gain || servo.d_gain != profile.position_d_gain ||
          (!held && servo.profile_ms != params_.period_us / 1000)) {
        fault("joint " + std::to_string(j) + " has torque and is not set up");
      }
      if ((unready_ >> j & 1) != 0) fault("a drive without power was thrown at its goal");
    }
  }
  /// A drive that has not heard of its controller for as long as it was told has stopped.
  void watch_orders(std::uint64_t now_us) {
    const std::uint64_t patience_us = 1000u * canopen::plan::patience_ms(params_) + kLater_us;
    for (int j = 0; j < params_.joint_count; ++j) {
      const sim::ServoSetpoint& servo = body_.plant().setpoint(j);
      const std::uint64_t heard_us = line_->trouble.ordered_us(node(j));
      const bool stale = heard_us != 0 && now_us > heard_us + patience_us;
      if (stale && servo.torque_on && servo.profile_ms != 0) {
        fault("joint " + std::to_string(j) + " has torque, and orders of nobody");
      }
    }
  }

  void finish() {
    keep();
    result_.damage = line_->trouble.damage();
    result_.intruder = intruder_->frames();
    result_.bus = line_->errors();
    result_.distance_m = (body_.position_m() - start_m_).norm();
    result_.fallen = body_.fallen();
    for (const std::vector<TickRecord>& each : traces_) replay(each);
    result_.violation = watch_.violation();
  }
  /// Its trace through the core once more has the same digests.
  void replay(const std::vector<TickRecord>& ticks) {
    result_.ticks_recorded += ticks.size();
    record::Trace trace;
    trace.params = params_;
    trace.ticks = ticks;
    const record::ReplayResult again = record::replay(trace);
    if (again.divergence) fault(record::text(*again.divergence, params_, "then", "now"));
  }

  static constexpr std::uint64_t kLater_us = 20'000;  // it looks once a millisecond

  const Params& params_;
  const CanPlan& plan_;
  std::minstd_rand random_;
  RunBody body_;
  RunWatch watch_;
  can::VirtualCan bus_;
  Intruder* intruder_ = nullptr;
  std::optional<Line> line_;
  OperatorDesk desk_;
  std::deque<std::vector<TickRecord>> traces_;  ///< one for each life of the controller
  std::unique_ptr<Board> board_;
  CanFaultResult result_;
  Eigen::Vector2d start_m_ = Eigen::Vector2d::Zero();
  std::uint32_t unready_ = 0;  ///< joints that lost their power, and the robot has not let go since
  std::uint64_t late_us_ = 0;  ///< when the loop came back from being busy elsewhere
  std::uint32_t ticks_ = 0;
  std::uint32_t changes_ = 0;  ///< of mode, since the fault began
  bool asks_ = true;           ///< the operator repeats its order to walk
  bool sags_ = false;          ///< the supply, while the robot walks
};

}  // namespace

CanFaultResult run_can_fault(const Robot& robot, const CanPlan& plan, std::uint32_t seed) {
  if (plan.chip) return CanFaultRun<ChipLine>(robot, plan, seed).run();
  return CanFaultRun<CanLine>(robot, plan, seed).run();
}

}  // namespace verp::test
