#include "firmware/app/feetech_writer.hpp"

#include "common/protocol/feetech_table.hpp"

namespace verp::app {

namespace mem = feetech::address;

void FeetechWriter::send(FeetechMaster& master, const Outputs& outputs, int turn,
                         std::uint32_t doubted) {
  if (params_.servo_count() == 0) return;
  const std::uint32_t wanted = outputs.torque_enable & all_joints(params_);
  const std::uint8_t strength = percent_in(outputs.mode);
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
  if (wanted != 0) send_strength(master);
  send_goals(master, outputs, torque_ & ~doubted);
  send_off(master);
}

void FeetechWriter::send_strength(FeetechMaster& master) {
  feetech::Encoder encoder(master.frame(), master.capacity());
  feetech::begin_sync_write(encoder, mem::kTorqueLimit, 2);
  for (int j = first_; j <= last_; ++j) {
    encoder.u8(params_.joint[j].servo_id);
    encoder.u16(strength_of(j, strength_));
  }
  master.send(encoder.finish());
}

void FeetechWriter::send_goals(FeetechMaster& master, const Outputs& outputs,
                               std::uint32_t joints) {
  if (joints == 0) return;
  feetech::Encoder encoder(master.frame(), master.capacity());
  feetech::begin_sync_write(encoder, mem::kTorqueEnable, 4);
  for (int j = 0; j < params_.servo_count(); ++j) {
    if ((joints >> j & 1) == 0) continue;
    encoder.u8(params_.joint[j].servo_id);
    encoder.u8(1);
    encoder.u8(0);  // acceleration: at once
    encoder.u16(feetech::to_magnitude(outputs.goal_count[j], feetech::kSign));
  }
  master.send(encoder.finish());
}

void FeetechWriter::send_off(FeetechMaster& master) {
  feetech::Encoder encoder(master.frame(), master.capacity());
  feetech::begin_sync_write(encoder, mem::kTorqueEnable, 1);
  int told = 0;
  for (int j = first_; j <= last_; ++j) {
    if ((torque_ >> j & 1) != 0) continue;
    encoder.u8(params_.joint[j].servo_id);
    encoder.u8(0);
    ++told;
  }
  if (told > 0) master.send(encoder.finish());
}

}  // namespace verp::app
