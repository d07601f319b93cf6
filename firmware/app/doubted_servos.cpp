#include "firmware/app/doubted_servos.hpp"

namespace verp::app {

void DoubtedServos::resolve(BusMaster& master, bool torque) {
  const std::uint32_t unresolved = open(torque);
  if (torque) renewals_ = 0;
  if (unresolved == 0) return;
  if (torque) {
    ask(master, some(unresolved));
  } else {
    renew(master);
  }
}

void DoubtedServos::ask(BusMaster& master, std::uint32_t joints) {
  ReadChain<kResolvedAtOnce> chain;
  for (int j = 0; j < params_.servo_count(); ++j) {
    if ((joints >> j & 1) != 0) {
      chain.add(params_.joint[j].servo_id, static_cast<std::uint8_t>(j));
    }
  }
  constexpr std::uint16_t kBytes = 1;
  const auto count = static_cast<std::size_t>(chain.count());
  const std::size_t frame =
      dxl::encode_sync_read(master.frame(), master.capacity(), dxl::Instruction::kSyncRead,
                            dxl::address::kTorqueEnable, kBytes, chain.ids(), count);
  chain.begin();
  master.request(frame, timeout_us(sync_read_bytes(count, kBytes), count, params_.baud),
                 [&](const dxl::Packet& packet) {
                   if (packet.size != kBytes) return Take::kStray;
                   const int joint = chain.match(packet.id);
                   if (joint < 0) return Take::kStray;
                   learn(joint, packet.parameters[0] != 0);
                   return chain.ended() ? Take::kDone : Take::kMore;
                 });
}

void DoubtedServos::renew(BusMaster& master) {
  if (renewals_ == 0) {
    batch_ = some(here_);
    renewals_ = kRepeats;
  }
  send_ram(master, dxl::address::kPositionDGain, &ServoRam::gains);
  send_ram(master, dxl::address::kProfileAcceleration, &ServoRam::motion);
  if (--renewals_ == 0) trust(batch_ & here_);
}

}  // namespace verp::app
