#include "firmware/app/feetech_servos.hpp"

#include "common/protocol/control_table.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "firmware/app/feetech_schedule.hpp"

namespace verp::app {

namespace mem = feetech::address;
namespace sense = feetech::sensor_block;

std::uint8_t hardware_error_of(std::uint8_t status) {
  constexpr struct {
    std::uint8_t status, error;
  } kBits[] = {{feetech::kVoltageStatus, dxl::kInputVoltageError},
               {feetech::kEncoderStatus, dxl::kEncoderError},
               {feetech::kTemperatureStatus, dxl::kOverheatingError},
               {feetech::kCurrentStatus, dxl::kElectricalShockError},
               {feetech::kOverloadStatus, dxl::kOverloadError}};
  unsigned error = 0;
  for (const auto& each : kBits) error |= (status & each.status) != 0 ? each.error : 0u;
  return static_cast<std::uint8_t>(error);
}

void FeetechDoubts::resolve(FeetechMaster& master, bool torque) {
  const std::uint32_t unresolved = open(torque);
  if (unresolved == 0) return;
  if (!torque) return trust(unresolved);
  const std::uint32_t joints = some(unresolved);
  ReadChain<kResolvedAtOnce> chain;
  for (int j = 0; j < params_.servo_count(); ++j) {
    if ((joints >> j & 1) != 0) chain.add(params_.joint[j].servo_id, static_cast<std::uint8_t>(j));
  }
  const auto count = static_cast<std::size_t>(chain.count());
  const std::size_t frame = feetech::encode_sync_read(master.frame(), master.capacity(),
                                                      mem::kTorqueEnable, 1, chain.ids(), count);
  chain.begin();
  master.request(frame, timeout_us(feetech_bytes::sync_read(count, 1), count, params_.baud),
                 [&](const feetech::Packet& packet) {
                   if (packet.size != 1) return Take::kStray;
                   const int joint = chain.match(packet.id);
                   if (joint < 0) return Take::kStray;
                   learn(joint, packet.parameters[0] == 1);
                   return chain.ended() ? Take::kDone : Take::kMore;
                 });
}

FeetechServos::FeetechServos(const Params& params, hal::FrameBus& bus)
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

BringUpReport FeetechServos::bring_up() {
  const BringUpReport report = app::bring_up(params_, master_);
  servos_.set_full(report.full_strength);
  return report;
}

void FeetechServos::read_positions(Inputs& inputs) {
  const auto count = static_cast<std::size_t>(joints_.count());
  spare_ = master_.spare_bytes();
  const auto length = static_cast<std::uint8_t>(kPositionBytes + spare_);
  const std::size_t frame = feetech::encode_sync_read(
      master_.frame(), master_.capacity(),
      static_cast<std::uint8_t>(mem::kPresentPosition - spare_), length, joints_.ids(), count);
  joints_.begin();
  for (int j = 0; j < params_.servo_count(); ++j) {
    doubted_.silent_for(j, silent_ticks_[j] * params_.period_us);
    if (silent_ticks_[j] < kLongSilence) ++silent_ticks_[j];
  }
  master_.request(frame, timeout_us(feetech_bytes::sync_read(count, length), count, params_.baud),
                  [&](const feetech::Packet& packet) { return take_position(packet, inputs); });
  joints_.complete();
}

Take FeetechServos::take_position(const feetech::Packet& packet, Inputs& inputs) {
  if (packet.size != std::size_t{kPositionBytes} + spare_) return Take::kStray;
  const int joint = joints_.match(packet.id);
  if (joint < 0) return Take::kStray;
  set_position(joint, packet, inputs);
  return joints_.ended() ? Take::kDone : Take::kMore;
}

void FeetechServos::set_position(int joint, const feetech::Packet& packet, Inputs& inputs) {
  const std::int32_t count =
      feetech::from_magnitude(feetech::get_u16(packet.parameters + spare_), feetech::kSign);
  if (!plausible_.counts(joint, count, silent_ticks_[joint])) {
    ++implausible_;
    return;
  }
  silent_ticks_[joint] = 0;
  if (!doubted_.counts(joint, (packet.code & feetech::kStatusBits) != 0)) return;
  inputs.position_count[joint] = count;
  inputs.fresh |= 1u << joint;
}

void FeetechServos::read_sensors(Inputs& inputs, bool imu) {
  if (sensors_.count() == 0) return;
  slow_joint_ =
      static_cast<std::uint8_t>(slow_joint_ + 1 < params_.servo_count() ? slow_joint_ + 1 : 0);
  sensors_.set_id(kServoSlot, params_.joint[slow_joint_].servo_id);
  const auto count = static_cast<std::size_t>(sensors_.count());
  spare_ = master_.spare_bytes();
  const auto length = static_cast<std::uint8_t>(sense::kBytes + spare_);
  const std::size_t frame = feetech::encode_sync_read(
      master_.frame(), master_.capacity(), static_cast<std::uint8_t>(sense::kAddress - spare_),
      length, sensors_.ids(), count);
  sensors_.begin();
  feet_seen_ = 0;
  master_.request(frame, timeout_us(feetech_bytes::sync_read(count, length), count, params_.baud),
                  [&](const feetech::Packet& packet) { return take_sensor(packet, inputs, imu); });
  sensors_.complete();
  if (feet_expected_ != 0 && feet_seen_ == feet_expected_) inputs.flags |= kFeetFresh;
  if ((inputs.flags & kSlowFresh) != 0 && inputs.slow_error != 0) read_torque();
}

Take FeetechServos::take_sensor(const feetech::Packet& packet, Inputs& inputs, bool imu) {
  if (packet.size != std::size_t{sense::kBytes} + spare_) return Take::kStray;
  const int slot = sensors_.match(packet.id);
  if (slot < 0) return Take::kStray;
  const std::uint8_t* data = packet.parameters + spare_;
  if (slot == kServoSlot) {
    set_slow(data, inputs);
  } else if (sense::check_of(packet.id, data) == feetech::get_u16(data + sense::kCheckAt)) {
    set_sensor(slot, data, inputs, imu);
  } else {
    ++implausible_;
  }
  return sensors_.ended() ? Take::kDone : Take::kMore;
}

void FeetechServos::set_sensor(int slot, const std::uint8_t* data, Inputs& inputs, bool imu) {
  if (slot == kImuSlot) {
    if (!imu) return;
    for (int axis = 0; axis < 3; ++axis) {
      inputs.gyro_count[axis] = static_cast<std::int16_t>(feetech::get_u16(data + 2 * axis));
      inputs.accel_count[axis] = static_cast<std::int16_t>(feetech::get_u16(data + 6 + 2 * axis));
    }
    inputs.flags |= kImuFresh;
    return;
  }
  const int foot = slot - kFootSlot;
  for (int i = 0; i < kFootSensors; ++i) {
    inputs.foot_count[foot][i] = feetech::get_u16(data + 2 * i);
  }
  feet_seen_ |= 1u << foot;
}

// Three readings in a row raise a fault (common/control/admit.cpp), so one damaged one does not.
void FeetechServos::set_slow(const std::uint8_t* data, Inputs& inputs) {
  inputs.slow_joint = slow_joint_;
  inputs.slow_voltage_tenth_v = data[mem::kPresentVoltage - sense::kAddress];
  inputs.slow_temperature_c = data[mem::kPresentTemperature - sense::kAddress];
  inputs.slow_error = hardware_error_of(data[mem::kStatus - sense::kAddress]);
  inputs.flags |= kSlowFresh;
}

void FeetechServos::read_torque() {
  const std::uint8_t id = params_.joint[slow_joint_].servo_id;
  const std::size_t frame =
      feetech::encode_read(master_.frame(), master_.capacity(), id, mem::kTorqueEnable, 1);
  master_.request(frame, timeout_us(feetech_bytes::read(1), 1, params_.baud),
                  [&](const feetech::Packet& packet) {
                    if (packet.id != id || packet.size != 1) return Take::kStray;
                    const bool limp = packet.parameters[0] == 0;
                    if (limp && servos_.has_torque()) doubted_.shut_down(slow_joint_);
                    return Take::kDone;
                  });
}

void FeetechServos::send(const Outputs& outputs) {
  servos_.send(master_, outputs, slow_joint_, doubted_.all());
  if (!servos_.told_all()) doubted_.resolve(master_, outputs.torque_enable != 0);
}

}  // namespace verp::app
