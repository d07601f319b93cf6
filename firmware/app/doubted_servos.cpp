#include "firmware/app/doubted_servos.hpp"

namespace verp::app {

void DoubtedServos::silent_for(int joint, std::uint32_t time_us) {
  if (time_us < patience_us_) return;
  doubted_ |= 1u << joint;
  here_ &= ~(1u << joint);
}

bool DoubtedServos::counts(int joint, bool alert) {
  if (!alert) broken_ &= ~(1u << joint);
  here_ |= doubted_ & ~broken_ & 1u << joint;
  return (doubted_ >> joint & 1) == 0;
}

void DoubtedServos::shut_down(int joint) {
  doubted_ |= 1u << joint;
  broken_ |= 1u << joint;
  here_ &= ~(1u << joint);
}

void DoubtedServos::resolve(BusMaster& master, bool torque) {
  if (!torque) limp_ = 0;
  if (torque) renewals_ = 0;
  const std::uint32_t open = here_ & ~limp_;
  if (open == 0) return;
  if (torque) {
    ask(master, some(open));
  } else {
    renew(master);
  }
}

std::uint32_t DoubtedServos::some(std::uint32_t joints) const {
  std::uint32_t chosen = 0;
  std::size_t count = 0;
  for (int j = 0; j < params_.servo_count() && count < kResolvedAtOnce; ++j) {
    if ((joints >> j & 1) == 0) continue;
    chosen |= 1u << j;
    ++count;
  }
  return chosen;
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

void DoubtedServos::learn(int joint, bool kept) {
  const std::uint32_t bit = 1u << joint;
  if (kept) trust(bit);
  if (!kept) limp_ |= bit;
}

void DoubtedServos::trust(std::uint32_t joints) {
  doubted_ &= ~joints;
  here_ &= ~joints;
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
