#include "tests/hil/fault_run.hpp"

#include "tests/hil/fault_scene.hpp"

namespace verp::test {
namespace {

constexpr double kFirstSteps_s = 1.2;

class FaultRun final : public FaultScene<FaultyLine, FaultPlan, FaultResult> {
 public:
  FaultRun(const Robot& robot, const FaultPlan& plan, std::uint32_t seed)
      : FaultScene(robot, plan, seed, kFirstSteps_s),
        bus_(params_, body_.plant()),
        line_(bus_, seed) {}

 private:
  FaultyLine& line() override { return line_; }
  std::uint8_t servo() const { return params_.joint[result_.joint].servo_id; }

  void begin() override {
    line_.faults = plan_.line;
    if (plan_.event == Event::kNone || plan_.event == Event::kLateLoop) return;
    ++result_.events;
    switch (plan_.event) {
      case Event::kServoGone:
        return bus_.set_connected(servo(), false);
      case Event::kServoUnpowered:
        unready_ = true;
        return bus_.set_powered(servo(), false);
      case Event::kReset:
        return restart();
      case Event::kImuGone:
        return bus_.set_connected(params_.imu.device_id, false);
      default:
        return begin_in_plant();
    }
  }
  void end() override {
    line_.faults = {};
    if (plan_.lasts_s > 0) {
      bus_.set_connected(servo(), true);
      bus_.set_powered(servo(), true);
    }
    if (plan_.event == Event::kImuGone) bus_.set_connected(params_.imu.device_id, true);
  }

  void disturb() override {
    if (plan_.event == Event::kFlutters) bus_.set_connected(servo(), !is_mute());
  }
  void watched_tick() override {
    const int joint = result_.joint;
    if (body_.on_stand()) {
      line_.wait_until(board_->clock.due_us());
      watch_.note_positions(board_->loop.outputs());
    }
    board_->tick();
    const Inputs& inputs = board_->loop.inputs();
    const Outputs& outputs = board_->loop.outputs();
    const bool repeats = plan_.event == Event::kRepeats;
    if (body_.on_stand()) watch_.watch_positions(inputs, repeats ? joint : RunWatch::kNobody);
    watch_.watch_silence(inputs);
    watch_gains();
    const bool gone = plan_.event == Event::kServoGone || plan_.event == Event::kFlutters;
    watch_.watch_torque(outputs, line_.now_us(), line_.faults.cut,
                        gone ? joint : RunWatch::kNobody);
    watch_.watch_fall(outputs, line_.now_us(), body_.lies());
  }
  void watch_gains() {
    unready_ = unready_ && board_->loop.outputs().torque_enable != 0;
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

  void finish() override {
    result_.damage = line_.damage();
    result_.stale = watch_.stale();
  }

  bus::VirtualBus bus_;
  FaultyLine line_;
  bool unready_ = false;  ///< result_.joint lost power since the robot relaxed
};

}  // namespace

FaultResult run_fault(const Robot& robot, const FaultPlan& plan, std::uint32_t seed) {
  return FaultRun(robot, plan, seed).run();
}

}  // namespace verp::test
