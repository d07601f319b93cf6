#include "tests/hil/can_fault_run.hpp"

#include <deque>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/protocol/canopen/robot_plan.hpp"
#include "host/trace/record/replay.hpp"
#include "tests/hil/chip_line.hpp"
#include "tests/hil/fault_scene.hpp"

namespace verp::test {
namespace {

constexpr double kFirstSteps_s = 0.6;
constexpr unsigned kOneBusOff = 33;  // ISO 11898-1: 32 errors of 8 points each
constexpr unsigned kManyErrors = 1'000'000;

template <class Line>
class CanFaultRun final : public FaultScene<Line, CanPlan, CanFaultResult> {
  using Scene = FaultScene<Line, CanPlan, CanFaultResult>;
  using Scene::board_, Scene::body_, Scene::ended, Scene::fault, Scene::params_, Scene::plan_;
  using Scene::random_, Scene::result_, Scene::watch_;

 public:
  CanFaultRun(const Robot& robot, const CanPlan& plan, std::uint32_t seed)
      : Scene(robot, plan, seed, kFirstSteps_s), bus_(params_, body_.plant()) {
    auto intruder = std::make_unique<Intruder>(params_, seed);
    intruder_ = intruder.get();
    bus_.plug_in(std::move(intruder));
    line_.emplace(bus_, seed);
  }

 private:
  static constexpr bool kChip = std::is_same_v<Line, ChipLine>;

  Line& line() override { return *line_; }
  std::vector<TickRecord>* trace() override { return &traces_.emplace_back(); }
  std::uint8_t node(int joint) const { return params_.joint[joint].servo_id; }
  void begin() override {
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
        return Scene::restart();
      case CanEvent::kImuGone:
        return bus_.set_connected(params_.imu.device_id, false);
      case CanEvent::kBusOff:
      case CanEvent::kBusOffs:
      case CanEvent::kShort:
        return begin_on_chip();
      default:
        return Scene::begin_in_plant();
    }
  }
  void begin_on_chip() {
    if constexpr (kChip) {
      if (plan_.event == CanEvent::kBusOff) line_->break_own(kOneBusOff);
      if (plan_.event == CanEvent::kBusOffs) line_->break_own(kManyErrors);
      if (plan_.event == CanEvent::kShort) line_->short_circuit(true);
    }
  }

  void end() override {
    line_->trouble.faults = {};
    intruder_->kind = Intruder::Kind::kSilent;
    if (plan_.lasts_s == 0) return;
    bus_.set_connected(node(result_.joint), true);
    bus_.set_powered(node(result_.joint), true);
    bus_.set_connected(params_.imu.device_id, true);
    if constexpr (kChip) {
      line_->break_own(0);
      line_->short_circuit(false);
    }
  }

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

  void disturb() override {
    if (plan_.event == CanEvent::kFlutters && mute_ != Scene::is_mute()) {
      mute_ = !mute_;
      bus_.set_connected(node(result_.joint), !mute_);
    }
    if (plan_.event != CanEvent::kManyReboot || ended() || random_() % 10 != 0) return;
    ++result_.events;
    reboot(static_cast<int>(random_() % params_.joint_count));
  }
  void watched_tick() override {
    const bool sharp = body_.on_stand() && plan_.intruder != Intruder::Kind::kTwin;
    line_->wait_until(board_->clock.due_us());
    if (sharp) watch_.note_positions(board_->loop.outputs());
    board_->tick();
    watch(sharp);
  }
  void watch(bool sharp) {
    const Inputs& inputs = board_->loop.inputs();
    const Outputs& outputs = board_->loop.outputs();
    const bool repeats = plan_.event == CanEvent::kRepeats;
    const bool gone = plan_.event == CanEvent::kNodeSilent || plan_.event == CanEvent::kFlutters;
    const bool cut = line_->trouble.faults.down || plan_.event == CanEvent::kBusOffs ||
                     plan_.event == CanEvent::kShort || plan_.intruder == Intruder::Kind::kFlood;
    const std::uint64_t now_us = bus_.now_us();
    if (sharp) watch_.watch_positions(inputs, repeats ? result_.joint : RunWatch::kNobody);
    watch_setup(outputs);
    watch_orders(now_us);
    watch_.watch_torque(outputs, now_us, cut && !ended(), gone ? result_.joint : RunWatch::kNobody);
    watch_.watch_fall(outputs, now_us, body_.lies());
  }
  /// No drive has torque before its set-up, or from a loss of power until the robot relaxes.
  void watch_setup(const Outputs& outputs) {
    if (outputs.torque_enable == 0) unready_ = 0;
    for (int j = 0; j < params_.joint_count; ++j) {
      const sim::ServoSetpoint& servo = body_.plant().setpoint(j);
      const ServoProfile& profile = app::profile_of(params_, j);
      if (!servo.torque_on) continue;
      const bool held = servo.profile_ms == 0;  // quick stop: no target is followed
      if (servo.p_gain != profile.position_p_gain || servo.d_gain != profile.position_d_gain ||
          (!held && servo.profile_ms != params_.period_us / 1000)) {
        fault("joint " + std::to_string(j) + " has torque and is not set up");
      }
      if ((unready_ >> j & 1) != 0) fault("a drive without power was thrown at its goal");
    }
  }
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

  void finish() override {
    result_.digest = board_->loop.state().digest.chain;
    result_.damage = line_->trouble.damage();
    result_.intruder = intruder_->frames();
    result_.bus = line_->errors();
    for (const std::vector<TickRecord>& each : traces_) replay(each);
  }
  void replay(const std::vector<TickRecord>& ticks) {
    result_.ticks_recorded += ticks.size();
    record::Trace trace;
    trace.params = params_;
    trace.ticks = ticks;
    const record::ReplayResult again = record::replay(trace);
    if (again.divergence) fault(record::text(*again.divergence, params_, "then", "now"));
  }

  static constexpr std::uint64_t kLater_us = 20'000;  // drives check once a millisecond

  can::VirtualCan bus_;
  Intruder* intruder_ = nullptr;
  std::optional<Line> line_;
  std::deque<std::vector<TickRecord>> traces_;  ///< per run of the controller
  bool mute_ = false;                           ///< a node that flutters
  std::uint32_t unready_ = 0;                   ///< joints without power since the robot relaxed
};

}  // namespace

CanFaultResult run_can_fault(const Robot& robot, const CanPlan& plan, std::uint32_t seed) {
  if (plan.chip) return CanFaultRun<ChipLine>(robot, plan, seed).run();
  return CanFaultRun<CanLine>(robot, plan, seed).run();
}

}  // namespace verp::test
