#pragma once
#include <cstdint>

#include "common/control/step.hpp"
#include "common/model/coupling.hpp"
#include "firmware/app/contracts.hpp"
#include "firmware/app/servos_on.hpp"
#include "hal/contract/imu.hpp"

/// The control loop, for real, virtual and emulated servos, over every bus in servos_on.hpp. Call
/// bring_up() once, then tick() once a period. The loop waits for no clock: in lockstep the tick's
/// first frame advances the bus to the next period; a board with a timer waits before tick().
namespace verp::app {

/// For a robot whose IMU is on the servo bus.
struct NoImu {
  hal::ImuStatus read(hal::ImuSample&) { return hal::ImuStatus::kStale; }
  std::uint32_t faults() const { return 0; }
};

/// The core as the controller of a tick. A PC user may substitute another (host/run/session).
struct Core {
  action::Library actions;
  void operator()(const Params& params, State& state, const Inputs& inputs, Outputs& outputs) {
    step(params, actions, state, inputs, outputs);
  }
};

template <class Bus, OperatorLink Operator, Recorder Sink, hal::Imu Chip = NoImu, class Law = Core>
class App {
 public:
  using Servos = typename ServosOn<Bus>::Type;
  static_assert(ServoBinding<Servos>);

  /// `chip` is the board's own IMU, or null. It is read if Params names no IMU on the bus or
  /// use_chip() selected it.
  App(const Params& params, Bus& bus, Operator& operator_link, Sink& sink, Chip* chip = nullptr,
      Law law = {})
      : params_(params),
        servos_(params, bus),
        operator_(operator_link),
        sink_(sink),
        chip_(chip),
        law_(law) {}

  /// Torque is off afterwards. Do not tick after a failure.
  BringUpReport bring_up() { return servos_.bring_up(); }
  /// Limits every servo's strength from the next tick on, for first steps: 1 to 100 %.
  void limit_torque(std::uint8_t percent) { servos_.limit_torque(percent); }

  void tick(const Beat& beat = {}) {
    inputs_.fresh = 0;
    inputs_.flags = 0;
    servos_.read_positions(inputs_);
    model::share_counts(params_, inputs_);
    count_tick(beat);
    servos_.read_sensors(inputs_, !from_chip_);
    read_chip();
    take_order();
    law_(params_, state_, inputs_, outputs_);
    servos_.send(outputs_);
    sink_.record(TickRecord{state_.digest, inputs_}, state_, outputs_);
  }

  /// Selects whose counts become Inputs from the next tick on: the chip's or the bus device's.
  /// Ignored while any servo holds torque or if one is missing.
  void use_chip(bool yes) {
    if (chip_ != nullptr && params_.imu.device_id != 0 && outputs_.torque_enable == 0)
      from_chip_ = yes;
  }

  const Inputs& inputs() const { return inputs_; }
  const Outputs& outputs() const { return outputs_; }
  const State& state() const { return state_; }
  const BusCounters& counters() const { return servos_.counters(); }
  std::uint32_t crc_errors() const { return servos_.damaged(); }
  std::uint32_t noise_bytes() const { return servos_.noise(); }
  const JointEffort* efforts() const { return servos_.efforts(); }

 private:
  // Counts ticks on the pacing clock, else on bus time at the end of the first read. Missed periods
  // are skipped.
  void count_tick(const Beat& beat) {
    const std::uint64_t now_us = servos_.now_us();
    if (ticking_) {
      const std::uint64_t elapsed_us = now_us - last_read_us_ + params_.period_us / 2;
      const auto periods = beat.periods > 0
                               ? beat.periods
                               : static_cast<std::uint32_t>(elapsed_us / params_.period_us);
      inputs_.tick += periods > 1 ? periods : 1;
      if (periods > 1 || beat.overran) inputs_.flags |= kOverrun;
      servos_.heard_nothing_for(elapsed_us);
    }
    ticking_ = true;
    last_read_us_ = now_us;
  }

  void read_chip() {
    hal::ImuSample sample;
    if (chip_ == nullptr || !from_chip_) return;
    const hal::ImuStatus status = chip_->read(sample);
    if (status != hal::ImuStatus::kFresh && status != hal::ImuStatus::kAssumed) return;
    for (int axis = 0; axis < 3; ++axis) {
      inputs_.gyro_count[axis] = sample.gyro_count[axis];
      inputs_.accel_count[axis] = sample.accel_count[axis];
    }
    inputs_.flags |= kImuFresh;
    if (status == hal::ImuStatus::kAssumed) inputs_.flags |= kImuAssumed;
  }

  void take_order() {
    constexpr std::uint16_t kOperatorFlags = kEmergencyStop | kCommandFresh | kParameterWrite;
    const OperatorOrder order = operator_.order(inputs_.tick);
    inputs_.command = order.command;
    inputs_.flags |= order.flags & kOperatorFlags;
    inputs_.parameter_id = order.parameter_id;
    inputs_.parameter_bits = order.parameter_bits;
    inputs_.mailbox = order.mailbox;
    inputs_.action = static_cast<std::uint8_t>(order.action);
  }

  const Params& params_;
  Servos servos_;
  Operator& operator_;
  Sink& sink_;
  Chip* chip_;
  [[no_unique_address]] Law law_;
  bool from_chip_ = params_.imu.device_id == 0;
  State state_;
  Inputs inputs_;
  Outputs outputs_;
  std::uint64_t last_read_us_ = 0;
  bool ticking_ = false;
};

}  // namespace verp::app
