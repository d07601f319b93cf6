#include "firmware/app/node_renewal.hpp"

namespace verp::app {

void NodeRenewal::rebooted(int slot) {
  if (slot == slot_) slot_ = -1;
  to_stop_ |= node_bit(slot);
}

bool NodeRenewal::stop_one(CanMaster& master) {
  for (int slot = 0; slot < kCanNodes; ++slot) {
    if ((to_stop_ & node_bit(slot)) == 0) continue;
    to_stop_ &= ~node_bit(slot);
    master.send(canopen::nmt_frame(canopen::NmtCommand::kStop, node_id(params_, slot)));
    return true;
  }
  return false;
}

int NodeRenewal::run(CanMaster& master, NodeMask candidates) {
  if (slot_ >= 0 && (candidates & node_bit(slot_)) == 0) slot_ = -1;
  if (slot_ < 0) {
    if (!choose(candidates, master.now_us())) return -1;
    // A stopped node would ignore the settings.
    master.send(
        canopen::nmt_frame(canopen::NmtCommand::kEnterPreOperational, node_id(params_, slot_)));
  }
  if (!proceed(master)) return -1;
  if (!finished_) return -1;
  const int done = slot_;
  slot_ = -1;
  master.send(canopen::nmt_frame(canopen::NmtCommand::kStart, node_id(params_, done)));
  return done;
}

bool NodeRenewal::proceed(CanMaster& master) {
  if (slot_ < 0 || !advance(master.now_us())) {
    ++master.counters.errors;
    return false;
  }
  CanFrame frame;
  if (!finished_ && client_.next(frame, master.now_us())) master.send(frame);
  return true;
}

bool NodeRenewal::choose(NodeMask candidates, std::uint64_t now_us) {
  for (int i = 0; i < kCanNodes; ++i) {
    last_ = last_ + 1 < kCanNodes ? last_ + 1 : 0;
    if ((candidates >> last_ & 1) == 0) continue;
    slot_ = last_;
    to_stop_ &= ~node_bit(slot_);
    client_ = canopen::SdoClient(node_id(params_, slot_));
    step_ = 0;
    begin(now_us);
    return true;
  }
  return false;
}

void NodeRenewal::begin(std::uint64_t now_us) {
  finished_ = !node_setting(params_, slot_, step_, setting_);
  if (finished_) return;
  canopen::put_le(data_, setting_.value, 4);
  client_.download(setting_.at, data_, setting_.bytes, canopen::SdoClient::Mode::kPlain, now_us);
}

bool NodeRenewal::advance(std::uint64_t now_us) {
  using State = canopen::SdoClient::State;
  if (client_.state() == State::kBusy || finished_) return true;
  if (client_.state() == State::kAborted) {
    const canopen::Abort why = client_.reason();
    const bool absent = why == canopen::Abort::kNoObject || why == canopen::Abort::kNoSubindex;
    if (!setting_.optional || !absent) {
      slot_ = -1;
      return false;
    }
  }
  ++step_;
  begin(now_us);
  return true;
}

}  // namespace verp::app
