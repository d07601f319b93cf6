#include "firmware/app/sync_repair.hpp"

namespace verp::app {

void SyncRepair::cancel(int slot) {
  if (slot == slot_) slot_ = -1;
}

void SyncRepair::run(CanMaster& master, NodeMask astray) {
  if (slot_ < 0 && !choose(astray & ~stubborn_)) return;
  if (asked_ && ++waited_ < kPatience) return;
  if (asked_ && ++missed_ >= kMostMissed) {
    slot_ = -1;
    return;
  }
  send(master);
}

bool SyncRepair::receive(CanMaster& master, const CanFrame& frame) {
  namespace sdo = canopen::sdo;
  if (!asked_ || frame.size != sdo::kFrameBytes || !(sdo::address_of(frame) == at())) {
    return false;
  }
  if (frame.data[0] == sdo::kAbort) {
    stubborn_ |= node_bit(slot_);
    slot_ = -1;
    return false;
  }
  if (sdo::specifier_of(frame) != sdo::response::kDownload) return false;
  asked_ = false;
  missed_ = 0;
  if (++step_ == steps()) {
    slot_ = -1;
    return true;
  }
  send(master);
  return false;
}

bool SyncRepair::choose(NodeMask astray) {
  for (int i = 0; i < kCanNodes && astray != 0; ++i) {
    last_ = last_ + 1 < kCanNodes ? last_ + 1 : 0;
    if ((astray >> last_ & 1) == 0) continue;
    slot_ = last_;
    step_ = missed_ = 0;
    asked_ = false;
    return true;
  }
  return false;
}

void SyncRepair::send(CanMaster& master) {
  namespace sdo = canopen::sdo;
  const std::uint8_t node = node_id(params_, slot_);
  const std::uint32_t off = step_ % 2 == 0 ? canopen::kPdoInvalid : 0;
  const std::uint32_t value = canopen::tpdo_id(number(), node) | canopen::kPdoNoRemote | off;
  const std::uint8_t command =
      sdo::command(sdo::request::kDownload, sdo::kExpedited | sdo::kSizeGiven);
  asked_ = true;
  waited_ = 0;
  master.send(sdo::addressed(canopen::sdo_request_id(node), command, at(), value));
}

}  // namespace verp::app
