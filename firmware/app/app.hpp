#pragma once
#include <cstdint>

#include "common/control/step.hpp"
#include "common/protocol/control_table.hpp"
#include "firmware/app/bring_up.hpp"
#include "firmware/app/bus_master.hpp"
#include "firmware/app/contracts.hpp"
#include "firmware/app/doubted_servos.hpp"
#include "firmware/app/schedule.hpp"
#include "firmware/app/servo_writer.hpp"
#include "hal/contract/imu.hpp"

/// The one control loop: the same template drives real servos, virtual ones and an emulated
/// microcontroller's. bring_up() once, then tick() once a control period. Nothing here knows where
/// the bytes go or waits for a clock: in lockstep the bus itself moves to the next period when the
/// tick's first read reaches it; a board with a timer waits before it calls tick().
namespace verp::app {

/// Of a robot whose IMU is on the servo bus.
struct NoImu {
  hal::ImuStatus read(hal::ImuSample&) { return hal::ImuStatus::kStale; }
  std::uint32_t faults() const { return 0; }
};

template <hal::FrameBus Bus, OperatorLink Operator, Recorder Sink, hal::Imu Chip = NoImu>
class App {
 public:
  /// `chip` is the board's own IMU, read in every tick if Params names none on the bus or
  /// use_chip() says so; null: there is none.
  App(const Params& params, Bus& bus, Operator& operator_link, Sink& sink, Chip* chip = nullptr)
      : params_(params), master_(bus), operator_(operator_link), sink_(sink), chip_(chip) {
    for (int j = 0; j < params.joint_count; ++j) {
      joints_.add(params.joint[j].servo_id, static_cast<std::uint8_t>(j));
    }
    if (params.imu.device_id != 0) sensors_.add(params.imu.device_id, kImuSlot);
    for (int foot = 0; foot < kFeet; ++foot) {
      const std::uint8_t id = params.feet.device_id[foot];
      if (id == 0) continue;
      sensors_.add(id, static_cast<std::uint8_t>(kFootSlot + foot));
      feet_expected_ |= 1u << foot;
    }
    if (params.joint_count > 0) sensors_.add(params.joint[0].servo_id, kServoSlot);
  }

  /// Call before the first tick; torque is off afterwards. Never ticks a robot that did not come
  /// up.
  BringUpReport bring_up() {
    const BringUpReport report = BringUp<Bus>(params_, master_).run();
    servos_.set_full(report.full_pwm);
    return report;
  }
  /// Of every servo's strength, from the next tick on: for a robot's first steps. 1 to 100.
  void limit_torque(std::uint8_t percent) { servos_.limit_torque(percent); }

  void tick(const Beat& beat = {}) {
    inputs_.fresh = 0;
    inputs_.flags = 0;
    read_positions();
    count_tick(beat);
    read_sensors();
    read_chip();
    take_order();
    step(params_, state_, inputs_, outputs_);
    servos_.send(master_, outputs_, slow_joint_, doubted_.all());
    if (!servos_.told_all()) doubted_.resolve(master_, outputs_.torque_enable != 0);
    sink_.record(TickRecord{state_.digest, inputs_}, state_, outputs_);
  }

  /// Whose counts become Inputs from the next tick on: the chip's, or the bus device's (which is
  /// asked all the same). Not while any servo holds torque; not what the robot does not have.
  void use_chip(bool yes) {
    if (chip_ != nullptr && params_.imu.device_id != 0 && outputs_.torque_enable == 0)
      from_chip_ = yes;
  }

  const Inputs& inputs() const { return inputs_; }
  const Outputs& outputs() const { return outputs_; }
  const State& state() const { return state_; }
  const BusCounters& counters() const { return master_.counters(); }
  std::uint32_t crc_errors() const { return master_.crc_errors(); }
  std::uint32_t noise_bytes() const { return master_.noise_bytes(); }

 private:
  enum Slot : std::uint8_t { kImuSlot = 0, kFootSlot = 1, kServoSlot = kFootSlot + kFeet };
  static constexpr std::uint16_t kPositionBytes = 4;
  static constexpr std::uint16_t kLongSilence = 5000;  ///< ticks; counted no further

  // Fast Sync Read is one packet for all, so one missing servo spoils it: after an incomplete read
  // the next one is plain, where each servo's reply stands for itself, until all answer again.
  void read_positions() {
    const auto count = static_cast<std::size_t>(joints_.count());
    const bool fast = all_fast_ && positions_complete_;
    spare_ = master_.spare_bytes();
    const auto length = static_cast<std::uint16_t>(kPositionBytes + spare_);
    const std::size_t frame =
        dxl::encode_sync_read(master_.frame(), master_.capacity(),
                              fast ? dxl::Instruction::kFastSyncRead : dxl::Instruction::kSyncRead,
                              static_cast<std::uint16_t>(dxl::address::kPresentPosition - spare_),
                              length, joints_.ids(), count);
    const std::size_t bytes =
        fast ? fast_sync_read_bytes(count, length) : sync_read_bytes(count, length);
    joints_.begin();
    for (int j = 0; j < params_.joint_count; ++j) {
      doubted_.silent_for(j, silent_ticks_[j] * params_.period_us);
      if (silent_ticks_[j] < kLongSilence) ++silent_ticks_[j];
    }
    master_.request(frame, timeout_us(bytes, fast ? 1 : count, params_.baud),
                    [&](const dxl::Packet& packet) {
                      return packet.is_fast_reply() ? take_fast(packet) : take_position(packet);
                    });
    positions_complete_ = fast ? joints_.ended() : joints_.complete();
  }

  Take take_position(const dxl::Packet& packet) {
    if (packet.size != std::size_t{kPositionBytes} + spare_) return Take::kStray;
    const int joint = joints_.match(packet.id);
    if (joint < 0) return Take::kStray;
    set_position(joint, packet.error, packet.parameters + spare_);
    return joints_.ended() ? Take::kDone : Take::kMore;
  }

  Take take_fast(const dxl::Packet& packet) {
    const auto count = static_cast<std::size_t>(joints_.count());
    const std::size_t length = std::size_t{kPositionBytes} + spare_;
    if (packet.size != count * (length + dxl::kFastBlockBytes)) return Take::kStray;
    dxl::FastBlock block;
    for (std::size_t i = 0; dxl::fast_block(packet, i, length, block); ++i) {
      const int joint = joints_.match(block.id);
      if (joint >= 0) set_position(joint, block.error, block.data + spare_);
    }
    return Take::kDone;
  }

  void set_position(int joint, std::uint8_t error, const std::uint8_t* data) {
    if ((error & ~dxl::kAlert) != 0) return;
    // One that was silent for so long may have heard nothing either.
    if (silent_ticks_[joint] * params_.period_us >= servos_.patience_us()) {
      servos_.expect_tripped();
    }
    silent_ticks_[joint] = 0;
    if (!doubted_.counts(joint, (error & dxl::kAlert) != 0)) return;
    inputs_.position_count[joint] = static_cast<std::int32_t>(dxl::get_u32(data));
    inputs_.fresh |= 1u << joint;
  }

  // Ticks are counted on the clock that paces them, or else on bus time, at the end of the first
  // read: a period that was missed is skipped, not squeezed.
  void count_tick(const Beat& beat) {
    const std::uint64_t now_us = master_.now_us();
    if (ticking_) {
      const std::uint64_t elapsed_us = now_us - last_read_us_ + params_.period_us / 2;
      const auto periods = beat.periods > 0
                               ? beat.periods
                               : static_cast<std::uint32_t>(elapsed_us / params_.period_us);
      inputs_.tick += periods > 1 ? periods : 1;
      if (periods > 1 || beat.overran) inputs_.flags |= kOverrun;
      if (elapsed_us >= servos_.patience_us()) servos_.expect_tripped();
    }
    ticking_ = true;
    last_read_us_ = now_us;
  }

  void read_sensors() {
    if (sensors_.count() == 0) return;
    slow_joint_ =
        static_cast<std::uint8_t>(slow_joint_ + 1 < params_.joint_count ? slow_joint_ + 1 : 0);
    sensors_.set_id(kServoSlot, params_.joint[slow_joint_].servo_id);
    const auto count = static_cast<std::size_t>(sensors_.count());
    spare_ = master_.spare_bytes();
    const auto length = static_cast<std::uint16_t>(dxl::sensor_block::kBytes + spare_);
    const std::size_t frame =
        dxl::encode_sync_read(master_.frame(), master_.capacity(), dxl::Instruction::kSyncRead,
                              static_cast<std::uint16_t>(dxl::sensor_block::kAddress - spare_),
                              length, sensors_.ids(), count);
    sensors_.begin();
    feet_seen_ = 0;
    slow_alert_ = false;
    master_.request(frame, timeout_us(sync_read_bytes(count, length), count, params_.baud),
                    [&](const dxl::Packet& packet) { return take_sensor(packet); });
    sensors_.complete();
    if (feet_expected_ != 0 && feet_seen_ == feet_expected_) inputs_.flags |= kFeetFresh;
    if (slow_alert_) read_hardware_error();
  }

  Take take_sensor(const dxl::Packet& packet) {
    if (packet.size != std::size_t{dxl::sensor_block::kBytes} + spare_) return Take::kStray;
    const int slot = sensors_.match(packet.id);
    if (slot < 0) return Take::kStray;
    if ((packet.error & ~dxl::kAlert) == 0)
      set_sensor(slot, packet.error, packet.parameters + spare_);
    return sensors_.ended() ? Take::kDone : Take::kMore;
  }

  void set_sensor(int slot, std::uint8_t error, const std::uint8_t* data) {
    if (slot == kImuSlot) {
      if (from_chip_) return;
      for (int axis = 0; axis < 3; ++axis) {
        inputs_.gyro_count[axis] = static_cast<std::int16_t>(dxl::get_u16(data + 2 * axis));
        inputs_.accel_count[axis] = static_cast<std::int16_t>(dxl::get_u16(data + 6 + 2 * axis));
      }
      inputs_.flags |= kImuFresh;
    } else if (slot == kServoSlot) {
      constexpr int kVoltageAt = dxl::address::kPresentVoltage - dxl::sensor_block::kAddress;
      constexpr int kTemperatureAt =
          dxl::address::kPresentTemperature - dxl::sensor_block::kAddress;
      inputs_.slow_joint = slow_joint_;
      inputs_.slow_voltage_tenth_v = dxl::get_u16(data + kVoltageAt);
      inputs_.slow_temperature_c = data[kTemperatureAt];
      inputs_.slow_error = 0;
      inputs_.flags |= kSlowFresh;
      slow_alert_ = (error & dxl::kAlert) != 0;
    } else {
      const int foot = slot - kFootSlot;
      for (int i = 0; i < kFootSensors; ++i) {
        inputs_.foot_count[foot][i] = dxl::get_u16(data + 2 * i);
      }
      feet_seen_ |= 1u << foot;
    }
  }

  void read_chip() {
    hal::ImuSample sample;
    if (chip_ == nullptr || !from_chip_) return;
    if (chip_->read(sample) != hal::ImuStatus::kFresh) return;
    for (int axis = 0; axis < 3; ++axis) {
      inputs_.gyro_count[axis] = sample.gyro_count[axis];
      inputs_.accel_count[axis] = sample.accel_count[axis];
    }
    inputs_.flags |= kImuFresh;
  }

  // The alert bit says that Hardware Error Status is not zero; only then is it worth a read of its
  // own, and so is whether the servo has shut off its torque, which stands a few bytes before.
  void read_hardware_error() {
    constexpr std::uint16_t kAddress = dxl::address::kTorqueEnable;
    constexpr std::uint16_t kBytes = kAlertBytes;
    static_assert(kAddress + kBytes == dxl::address::kHardwareError + 1);
    const std::uint8_t id = params_.joint[slow_joint_].servo_id;
    const std::size_t frame =
        dxl::encode_read(master_.frame(), master_.capacity(), id, kAddress, kBytes);
    const bool answered =
        master_.request(frame, timeout_us(frame + dxl::kStatusBytes + kBytes, 1, params_.baud),
                        [&](const dxl::Packet& packet) {
                          if (packet.id != id || packet.size != kBytes) return Take::kStray;
                          inputs_.slow_error = packet.parameters[kBytes - 1];
                          const bool limp = packet.parameters[0] == 0;
                          if (limp && servos_.has_torque()) doubted_.shut_down(slow_joint_);
                          return Take::kDone;
                        });
    if (!answered) inputs_.flags &= static_cast<std::uint16_t>(~kSlowFresh);
  }

  void take_order() {
    constexpr std::uint16_t kOperatorFlags = kEmergencyStop | kCommandFresh | kParameterWrite;
    const OperatorOrder order = operator_.order(inputs_.tick);
    inputs_.command = order.command;
    inputs_.flags |= order.flags & kOperatorFlags;
    inputs_.parameter_id = order.parameter_id;
    inputs_.parameter_bits = order.parameter_bits;
    inputs_.mailbox = order.mailbox;
  }

  const Params& params_;
  BusMaster<Bus> master_;
  ServoWriter<Bus> servos_{params_};
  DoubtedServos<Bus> doubted_{params_};
  Operator& operator_;
  Sink& sink_;
  Chip* chip_;
  bool from_chip_ = params_.imu.device_id == 0;
  ReadChain<kMaxJoints> joints_;
  ReadChain<kServoSlot + 1> sensors_;
  State state_;
  Inputs inputs_;
  Outputs outputs_;
  std::uint64_t last_read_us_ = 0;
  std::uint16_t silent_ticks_[kMaxJoints] = {};  ///< since each servo answered
  std::uint32_t feet_expected_ = 0;
  std::uint32_t feet_seen_ = 0;
  std::uint8_t spare_ = 0;  ///< of the read under way
  std::uint8_t slow_joint_ = 0;
  bool slow_alert_ = false;
  bool ticking_ = false;  ///< a tick was counted before
  bool positions_complete_ = true;
  const bool all_fast_ = all_fast(params_);
};

}  // namespace verp::app
