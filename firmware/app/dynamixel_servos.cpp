#include "firmware/app/dynamixel_servos.hpp"

namespace verp::app {

DynamixelServos::DynamixelServos(const Params& params, hal::FrameBus& bus)
    : params_(params), master_(bus) {
  for (int j = 0; j < params.servo_count(); ++j) {
    joints_.add(params.joint[j].servo_id, static_cast<std::uint8_t>(j));
  }
  if (params.imu.device_id != 0) sensors_.add(params.imu.device_id, kImuSlot);
  for (int foot = 0; foot < kFeet; ++foot) {
    const std::uint8_t id = params.feet.device_id[foot];
    if (id == 0) continue;
    sensors_.add(id, static_cast<std::uint8_t>(kFootSlot + foot));
    feet_expected_ |= 1u << foot;
  }
  if (params.servo_count() > 0) sensors_.add(params.joint[0].servo_id, kServoSlot);
}

BringUpReport DynamixelServos::bring_up() {
  const BringUpReport report = app::bring_up(params_, master_);
  servos_.set_full(report.full_strength);
  return report;
}

void DynamixelServos::read_positions(Inputs& inputs) {
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
  for (int j = 0; j < params_.servo_count(); ++j) {
    doubted_.silent_for(j, silent_ticks_[j] * params_.period_us);
    if (silent_ticks_[j] < kLongSilence) ++silent_ticks_[j];
  }
  master_.request(
      frame, timeout_us(bytes, fast ? 1 : count, params_.baud), [&](const dxl::Packet& packet) {
        return packet.is_fast_reply() ? take_fast(packet, inputs) : take_position(packet, inputs);
      });
  positions_complete_ = fast ? joints_.ended() : joints_.complete();
}

void DynamixelServos::heard_nothing_for(std::uint64_t time_us) {
  if (time_us >= servos_.patience_us()) servos_.expect_tripped();
}

void DynamixelServos::read_sensors(Inputs& inputs, bool imu) {
  if (sensors_.count() == 0) return;
  slow_joint_ =
      static_cast<std::uint8_t>(slow_joint_ + 1 < params_.servo_count() ? slow_joint_ + 1 : 0);
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
                  [&](const dxl::Packet& packet) { return take_sensor(packet, inputs, imu); });
  sensors_.complete();
  if (feet_expected_ != 0 && feet_seen_ == feet_expected_) inputs.flags |= kFeetFresh;
  if (slow_alert_) read_hardware_error(inputs);
}

void DynamixelServos::send(const Outputs& outputs) {
  servos_.send(master_, outputs, slow_joint_, doubted_.all());
  if (!servos_.told_all()) doubted_.resolve(master_, outputs.torque_enable != 0);
}

Take DynamixelServos::take_position(const dxl::Packet& packet, Inputs& inputs) {
  if (packet.size != std::size_t{kPositionBytes} + spare_) return Take::kStray;
  const int joint = joints_.match(packet.id);
  if (joint < 0) return Take::kStray;
  set_position(joint, packet.error, packet.parameters + spare_, inputs);
  return joints_.ended() ? Take::kDone : Take::kMore;
}

Take DynamixelServos::take_fast(const dxl::Packet& packet, Inputs& inputs) {
  const auto count = static_cast<std::size_t>(joints_.count());
  const std::size_t length = std::size_t{kPositionBytes} + spare_;
  if (packet.size != count * (length + dxl::kFastBlockBytes)) return Take::kStray;
  dxl::FastBlock block;
  for (std::size_t i = 0; dxl::fast_block(packet, i, length, block); ++i) {
    const int joint = joints_.match(block.id);
    if (joint >= 0) set_position(joint, block.error, block.data + spare_, inputs);
  }
  return Take::kDone;
}

void DynamixelServos::set_position(int joint, std::uint8_t error, const std::uint8_t* data,
                                   Inputs& inputs) {
  if ((error & ~dxl::kAlert) != 0) return;
  // A servo silent for this long may have received nothing either.
  if (silent_ticks_[joint] * params_.period_us >= servos_.patience_us()) {
    servos_.expect_tripped();
  }
  silent_ticks_[joint] = 0;
  if (!doubted_.counts(joint, (error & dxl::kAlert) != 0)) return;
  inputs.position_count[joint] = static_cast<std::int32_t>(dxl::get_u32(data));
  inputs.fresh |= 1u << joint;
}

Take DynamixelServos::take_sensor(const dxl::Packet& packet, Inputs& inputs, bool imu) {
  if (packet.size != std::size_t{dxl::sensor_block::kBytes} + spare_) return Take::kStray;
  const int slot = sensors_.match(packet.id);
  if (slot < 0) return Take::kStray;
  if ((packet.error & ~dxl::kAlert) == 0)
    set_sensor(slot, packet.error, packet.parameters + spare_, inputs, imu);
  return sensors_.ended() ? Take::kDone : Take::kMore;
}

void DynamixelServos::set_sensor(int slot, std::uint8_t error, const std::uint8_t* data,
                                 Inputs& inputs, bool imu) {
  if (slot == kImuSlot) {
    if (!imu) return;
    for (int axis = 0; axis < 3; ++axis) {
      inputs.gyro_count[axis] = static_cast<std::int16_t>(dxl::get_u16(data + 2 * axis));
      inputs.accel_count[axis] = static_cast<std::int16_t>(dxl::get_u16(data + 6 + 2 * axis));
    }
    inputs.flags |= kImuFresh;
  } else if (slot == kServoSlot) {
    constexpr int kVoltageAt = dxl::address::kPresentVoltage - dxl::sensor_block::kAddress;
    constexpr int kTemperatureAt = dxl::address::kPresentTemperature - dxl::sensor_block::kAddress;
    inputs.slow_joint = slow_joint_;
    inputs.slow_voltage_tenth_v = dxl::get_u16(data + kVoltageAt);
    inputs.slow_temperature_c = data[kTemperatureAt];
    inputs.slow_error = 0;
    inputs.flags |= kSlowFresh;
    slow_alert_ = (error & dxl::kAlert) != 0;
  } else {
    const int foot = slot - kFootSlot;
    for (int i = 0; i < kFootSensors; ++i) {
      inputs.foot_count[foot][i] = dxl::get_u16(data + 2 * i);
    }
    feet_seen_ |= 1u << foot;
  }
}

void DynamixelServos::read_hardware_error(Inputs& inputs) {
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
                        inputs.slow_error = packet.parameters[kBytes - 1];
                        const bool limp = packet.parameters[0] == 0;
                        if (limp && servos_.has_torque()) doubted_.shut_down(slow_joint_);
                        return Take::kDone;
                      });
  if (!answered) inputs.flags &= static_cast<std::uint16_t>(~kSlowFresh);
}

}  // namespace verp::app
