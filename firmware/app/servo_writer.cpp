#include "firmware/app/servo_writer.hpp"

namespace verp::app {

void ServoWriter::send(BusMaster& master, const Outputs& outputs, int turn, std::uint32_t doubted) {
  if (params_.servo_count() == 0) return;
  const std::uint32_t wanted = outputs.torque_enable & all_joints(params_);
  const std::uint8_t strength = percent_in(outputs.mode);
  if (wanted != 0 && (watchdog_clears_ > 0 || torque_ == 0)) clear_watchdogs(master);
  if ((wanted & ~wanted_) != 0) {
    early_ = kRepeats - 1;
  } else if (early_ > 0) {
    --early_;
  }
  const std::uint32_t torque = early_ > 0 ? torque_ & wanted : wanted;
  if (torque != torque_ || wanted != wanted_ || (wanted != 0 && strength != strength_)) {
    repeats_ = kRepeats;
  }
  if (wanted != 0) strength_ = strength;
  torque_ = torque;
  wanted_ = wanted;
  told_all_ = repeats_ > 0;
  first_ = told_all_ ? 0 : turn;
  last_ = told_all_ ? params_.servo_count() - 1 : turn;
  if (told_all_) --repeats_;
  if (wanted != 0) {
    send_strength(master);
    send_goals(master, outputs);
  }
  send_to(master, dxl::address::kTorqueEnable, 1, doubted & torque_);
  send_to(master, dxl::address::kBusWatchdog, bus_watchdog_);
}

void ServoWriter::clear_watchdogs(BusMaster& master) {
  first_ = 0;
  last_ = params_.servo_count() - 1;
  send_to(master, dxl::address::kBusWatchdog, 0);
  repeats_ = kRepeats;
  if (watchdog_clears_ > 0) --watchdog_clears_;
}

void ServoWriter::send_goals(BusMaster& master, const Outputs& outputs) {
  dxl::Encoder encoder(master.frame(), master.capacity());
  dxl::begin_sync_write(encoder, dxl::address::kGoalPosition, 4);
  for (int j = 0; j < params_.servo_count(); ++j) {
    if ((wanted_ >> j & 1) == 0) continue;
    encoder.u8(params_.joint[j].servo_id);
    encoder.u32(static_cast<std::uint32_t>(outputs.goal_count[j]));
  }
  master.send(encoder.finish());
}

void ServoWriter::send_strength(BusMaster& master) {
  dxl::Encoder encoder(master.frame(), master.capacity());
  dxl::begin_sync_write(encoder, dxl::address::kGoalPwm, 2);
  for (int j = first_; j <= last_; ++j) {
    const std::uint16_t pwm = strength_of(j, strength_);
    encoder.u8(params_.joint[j].servo_id);
    encoder.u8(static_cast<std::uint8_t>(pwm));
    encoder.u8(static_cast<std::uint8_t>(pwm >> 8));
  }
  master.send(encoder.finish());
}

void ServoWriter::send_to(BusMaster& master, std::uint16_t address, std::uint8_t value,
                          std::uint32_t left_out) {
  dxl::Encoder encoder(master.frame(), master.capacity());
  dxl::begin_sync_write(encoder, address, 1);
  int told = 0;
  for (int j = first_; j <= last_; ++j) {
    if ((left_out >> j & 1) != 0) continue;
    encoder.u8(params_.joint[j].servo_id);
    encoder.u8((torque_ >> j & 1) != 0 ? value : std::uint8_t{0});
    ++told;
  }
  if (told > 0) master.send(encoder.finish());
}

}  // namespace verp::app
